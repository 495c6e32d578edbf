// How far image B is from image A, sample by sample; error = b - a, in the stored units of the two
// (levels of integer images, the values of float images). Pure: rows in, numbers out.
//
// Formulas: mean = sum |error| / samples, RMS = sqrt(sum error^2 / samples), PSNR = 20 log10(peak /
// RMS), samples = pixels x channels: the definitions of OpenImageIO's idiff.
// Two samples are the same where their bits are, or where both are NaN, of whatever bits. So 0 and
// -0 of a float image differ, by an error of 0: what is called identical is so bit for bit, as in
// run.json's pixel_sha1. A sample that is not finite
// in A or in B has no error: it is counted and named, and left out of every mean and maximum.
// One thread adds rows in order, one sample after the other with compensated (Neumaier) sums, so
// that a result does not depend on how the rows came in bands, to the last bit.
// Of 2^30 samples, in any order, in parts that are added up in any way, mean_abs, RMS and PSNR are
// within 1e-12 of exact arithmetic, relative, and mean_signed within 1e-12 of mean_abs: where
// errors cancel it has no other scale, because each b - a of floats is rounded already. For every
// type of sample but doubles of more than 1e150 or, if not 0, less than 1e-150: their squares are
// none. docs/arithmetic.md says what is defined where nothing differs, and how this was tested.
#pragma once

#include "section.h"

#include <cmath>
#include <optional>
#include <span>
#include <string_view>
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
    void add(const Sum& other) {
        add(other.total_);
        add(other.carry_);
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
    void add(const ErrorSums& other);                           // of other samples

    long long samples() const { return samples_; }
    std::optional<double> mean_signed() const { return mean(signed_); }
    std::optional<double> mean_abs() const { return mean(absolute_); }
    std::optional<double> rms() const;  // none too where a square is beyond a double
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
    // Why there is none, in the words of all our output; empty where there is one. "infinite: ..."
    // or "undefined: ...".
    std::string_view why_no_psnr() const;
};

class MetricsBuilder {
  public:
    explicit MetricsBuilder(const ImageShape& shape);
    // Rows 0, 1, ... in order, each width x channels, interleaved.
    void add_row(int y, std::span<const double> a, std::span<const double> b);
    Metrics result() const;

  private:
    void add_sample(int x, int y, int channel, double a, double b);
    void note_nonfinite(int x, int y, int channel, double a, double b);

    ImageShape shape_;
    Metrics metrics_;  // but for `all`, which is made of the channels
    std::size_t places_a_ = 0, places_b_ = 0;
};

}  // namespace mpipov
