// How far equally right renders of one scene lie from each other. Pure: rows in, numbers out.
#pragma once

#include "metrics.h"
#include "variance.h"

#include <optional>
#include <span>
#include <vector>

namespace mpipov {

// What stored values are rounded to; rounding alone has a variance of step^2 / 12.
struct Quantisation {
    enum class Kind { levels, half, shared_exponent, float32 } kind = Kind::levels;
    // `value`: the sample, `brightest`: the largest channel of its pixel, both finite. Levels: 1;
    // half: 2^-10 of the value; shared exponent (Radiance HDR): 2^-7
    // of the brightest channel; float: 2^-23 of the value.
    double step(double value, double brightest) const;
    double variance(double value, double brightest) const;
};

// A scene's noise, from n >= 2 renders that are equally right.
struct NoiseFloor {
    int renders = 0;
    // Root of the mean over samples of the variance over renders: how far one render's sample is
    // from its expected value, in stored units. None where no sample is finite in all renders.
    std::optional<double> sigma;
    long long samples = 0;  // that are finite in all renders
    long long noisy = 0;    // of those: not the same in all renders
    double largest_sigma = 0;
    int x = 0, y = 0, channel = 0;  // of the largest, the first in reading order
};

// Memory: nothing that grows with the image.
class NoiseFloorBuilder {
  public:
    explicit NoiseFloorBuilder(const ImageShape& shape) : shape_(shape) {}
    // Row y of every render, each width x channels, interleaved.
    void add_row(int y, std::span<const std::span<const double>> renders);
    NoiseFloor result() const;

  private:
    ImageShape shape_;
    NoiseFloor floor_;
    Sum variances_;
};

}  // namespace mpipov
