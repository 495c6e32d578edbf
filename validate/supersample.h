// Averages k x k samples of each pixel into a picture that is closer to the truth than any of its
// renders, and says how close. Pure: rows of samples in, pixels out.
//
// A sample is a pixel of a render k times as wide and high, in linear light and not clipped, as
// POV-Ray's own antialiasing averages them (docs/povray.md). What comes out is encoded by the sRGB
// curve (IEC 61966-2-1) and clipped to 0..1, as POV-Ray encodes a PNG.
//
// Its own error. The samples of a pixel with even and odd column and row are four interleaved grids
// of k/2 x k/2 (k must be even). Were their four means m_i independent, the variance of their mean
// would be sum (m_i - m)^2 / (4 * 3), the standard error of a mean of four; that is taken for each
// pixel and channel, of the encoded means, and averaged over all. Random samples (jitter, focal
// blur) are independent, and the estimate has no bias; on an edge or a slope the errors of the four
// grids partly cancel, and it is too large: on a straight edge about 1.4 times.
#pragma once

#include <optional>
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
    std::vector<double> pixels;                     // width x height x 3, encoded, 0..1
    double sampling_error = 0, rounding_error = 0;  // RMS, encoded, 0..1
};

class Supersampler {
  public:
    // width x height pixels of `factor` x `factor` samples, factor even.
    Supersampler(int width, int height, int factor, Averaging averaging);

    // Row y of the samples, 0 first: 3 values for each of width x factor samples. Values that are
    // not finite count as 0.
    void add_row(int y, std::span<const double> samples);

    Supersampled result() const;

  private:
    int width_, height_, factor_;
    Averaging averaging_;
    std::vector<double> sums_;  // height x width x 3 x 4 grids
};

// The mean of two of equal size, whose samples are independent, and the RMS of half their
// difference: the standard error of a mean of two.
struct Combined {
    Supersampled picture;
    double order_error = 0;
};
Combined combine(const Supersampled& a, const Supersampled& b);

}  // namespace mpipov
