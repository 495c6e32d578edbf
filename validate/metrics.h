// How far image B is from image A, sample by sample; error = b - a, in the stored units of the two
// (levels of integer images, the values of float images). Pure: rows in, numbers out.
//
// Formulas: mean = sum |error| / samples, RMS = sqrt(sum error^2 / samples), PSNR = 20 log10(peak /
// RMS), samples = pixels x channels: the definitions of OpenImageIO's idiff.
// Two samples are the same where their bits are, or where both are NaN, of whatever bits. So 0 and
// -0 of a float image differ, by an error of 0: what is called identical is so bit for bit, as in
// run.json's pixel_sha1. A sample that is not finite
// in A or in B has no error: it is counted and named, and left out of every mean and maximum.
// Rows are added in order, one sample after the other with compensated (Neumaier) sums, so that a
// result depends neither on how the rows came in bands nor, below 2^106, on rounding.
#pragma once

#include "section.h"

#include <cmath>
#include <optional>
#include <span>
#include <vector>

namespace mpipov {

struct ImageShape {
    int width = 0, height = 0, channels = 0;
    int alpha = -1;  // index of the alpha channel, -1 where there is none
};

inline bool same_value(double a, double b) {
    return (a == b && std::signbit(a) == std::signbit(b)) || (std::isnan(a) && std::isnan(b));
}

// Whether any of the channels differs.
bool pixel_differs(const double* a, const double* b, int channels);

// Neumaier's compensated sum.
class Sum {
  public:
    void add(double value) {
        const double total = total_ + value;
        carry_ += std::abs(total_) >= std::abs(value) ? (total_ - total) + value
                                                      : (value - total) + total_;
        total_ = total;
    }
    double value() const { return total_ + carry_; }

  private:
    double total_ = 0, carry_ = 0;
};

// The errors of any set of samples. Nothing is defined over no finite sample.
class ErrorSums {
  public:
    void add(double a, double b) {
        const double error = b - a;
        if (!std::isfinite(error)) return;
        ++samples_;
        if (error == 0) return;
        signed_.add(error);
        absolute_.add(std::abs(error));
        square_.add(error * error);
        if (std::abs(error) > max_) max_ = std::abs(error);
    }
    void add_equal(long long samples) { samples_ += samples; }  // finite ones

    long long samples() const { return samples_; }
    std::optional<double> mean_signed() const { return mean(signed_); }
    std::optional<double> mean_abs() const { return mean(absolute_); }
    std::optional<double> rms() const;
    std::optional<double> max() const;

  private:
    std::optional<double> mean(const Sum& sum) const;

    long long samples_ = 0;
    Sum signed_, absolute_, square_;
    double max_ = 0;
};

struct PixelCounts {
    long long pixels = 0, differing = 0;
};

// The first in reading order where several are equally large.
struct LargestError {
    int x = 0, y = 0, channel = 0;
    double a = 0, b = 0;
};

struct NonFinitePlace {
    char image = 'a';  // 'a' or 'b'
    int x = 0, y = 0, channel = 0;
    double value = 0;
};

struct NonFinite {
    static constexpr std::size_t places_kept = 8;  // per image

    long long nan_a = 0, infinite_a = 0, nan_b = 0, infinite_b = 0;
    long long mismatches = 0;           // samples not finite in A or B, and not the same in both
    std::vector<NonFinitePlace> first;  // in reading order, at most places_kept of each image

    long long total() const { return nan_a + infinite_a + nan_b + infinite_b; }
};

struct Metrics {
    PixelCounts counts;
    Rect differing_box;  // of the differing pixels; empty where there are none
    ErrorSums all;
    std::vector<ErrorSums> channels;
    std::optional<LargestError> largest;  // none where no finite sample differs
    long long zero_signs = 0;             // samples that are 0 in one image and -0 in the other
    NonFinite nonfinite;

    bool identical() const { return counts.differing == 0; }
    // Decibels; none where RMS is 0 or undefined. `peak` in the units of the samples.
    std::optional<double> psnr(double peak) const;
};

class MetricsBuilder {
  public:
    explicit MetricsBuilder(const ImageShape& shape);
    // Rows 0, 1, ... in order, each width x channels, interleaved.
    void add_row(int y, std::span<const double> a, std::span<const double> b);
    const Metrics& result() const { return metrics_; }

  private:
    void add_sample(int x, int y, int channel, double a, double b);
    void note_nonfinite(int x, int y, int channel, double a, double b);

    ImageShape shape_;
    Metrics metrics_;
    std::size_t places_a_ = 0, places_b_ = 0;
};

}  // namespace mpipov
