// Averages k x k samples of each pixel into a picture that is closer to the truth than any of its
// renders, and says how close. Pure: rows of samples in, pixels out.
//
// A sample is a pixel of a render k times as wide and high, in linear light and not clipped, as
// POV-Ray's own antialiasing averages them (docs/povray.md). What comes out is encoded by the sRGB
// curve (IEC 61966-2-1) and clipped to 0..1, as POV-Ray encodes a PNG.
//
// Its own error. The truth is made of two pictures A and B of a x a and b x b samples a pixel that
// share hardly any sample, weighted by their numbers: T = (a^2 A + b^2 B) / (a^2 + b^2). Where a
// sample's variance is v, that of T is v / (a^2 + b^2) and that of A - B is v (1/a^2 + 1/b^2): the
// error of T is a b / (a^2 + b^2) times the RMS of A - B. That holds exactly where samples are
// independent (jitter, focal blur, two radiosity caches); on an edge or a slope, where the error of
// a grid goes with a higher power of its samples, with a = 8 and b = 10 it still does within a
// tenth.
#pragma once

#include <span>
#include <vector>

namespace mpipov {

// The sRGB curve, clipped to 0..1.
double srgb_encoded(double linear);

// What rounding to half precision does to that, RMS, for a value rounded once: the gap to the next
// half number, through sqrt(12), times the slope of the curve. Averaging makes it less, but not
// where all samples are alike: so an upper bound.
double half_rounding(double linear);

// Where samples are averaged. linear: in linear light. encoded: in sRGB-encoded values, as POV-Ray
// itself does in a scene without assumed_gamma, and nearly so with assumed_gamma 2.2.
enum class Averaging { linear, encoded };

struct Supersampled {
    int width = 0, height = 0;
    int factor = 0;  // k
    Averaging averaging = Averaging::linear;
    std::vector<double> means;  // width x height x 3, as averaged

    std::vector<double> encoded() const;  // 0..1
};

class Supersampler {
  public:
    // width x height pixels of `factor` x `factor` samples.
    Supersampler(int width, int height, int factor, Averaging averaging);

    // Row y of the samples, 0 first: 3 values for each of width x factor samples. Values that are
    // not finite count as 0.
    void add_row(int y, std::span<const double> samples);

    Supersampled result() const;

  private:
    Supersampled picture_;
};

struct Combined {
    Supersampled picture;
    double sampling_error = 0, rounding_error = 0;  // RMS, encoded, 0..1
};
// Of two of equal size and averaging.
Combined combine(const Supersampled& a, const Supersampled& b);

}  // namespace mpipov
