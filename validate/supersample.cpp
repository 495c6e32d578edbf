#include "supersample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace mpipov {
namespace {

constexpr std::size_t grids = 4, channels = 3;
constexpr double knee = 0.0031308;

// Beyond 1 too: averaging comes before clipping.
double curve(double linear) {
    return linear <= knee ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double slope(double linear) {
    return linear <= knee ? 12.92 : 1.055 / 2.4 * std::pow(linear, 1 / 2.4 - 1);
}

double inverse(double encoded) {
    return encoded <= curve(knee) ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

}  // namespace

double srgb_encoded(double linear) {
    return std::clamp(curve(linear), 0.0, 1.0);
}

double half_rounding(double linear) {
    if (linear <= 0 || linear >= 1) return 0;
    constexpr int smallest_exponent = -14, digits = 10;
    const int exponent = std::max(std::ilogb(linear), smallest_exponent);
    return std::ldexp(1.0, exponent - digits) / std::sqrt(12.0) * slope(linear);
}

Supersampler::Supersampler(int width, int height, int factor, Averaging averaging)
    : width_(width),
      height_(height),
      factor_(factor),
      averaging_(averaging),
      sums_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * channels * grids) {
}

void Supersampler::add_row(int y, std::span<const double> samples) {
    const auto row = static_cast<std::size_t>(y / factor_) * static_cast<std::size_t>(width_);
    const std::size_t odd_row = y % 2 == 1 ? 2 : 0;
    const auto factor = static_cast<std::size_t>(factor_);
    for (std::size_t x = 0; x < samples.size() / channels; ++x) {
        double* sums = &sums_[(row + x / factor) * channels * grids + odd_row + x % 2];
        for (std::size_t c = 0; c < channels; ++c) {
            const double sample = samples[x * channels + c];
            if (!std::isfinite(sample)) continue;
            sums[c * grids] += averaging_ == Averaging::linear ? sample : curve(sample);
        }
    }
}

Supersampled Supersampler::result() const {
    Supersampled found{width_, height_, {}, 0, 0};
    const double of_grid = factor_ * factor_ / static_cast<double>(grids);
    const auto encode = [&](double mean) {
        return averaging_ == Averaging::linear ? srgb_encoded(mean) : std::clamp(mean, 0.0, 1.0);
    };
    double sampling = 0, rounding = 0;
    for (std::size_t at = 0; at < sums_.size(); at += grids) {
        double mean = 0, of_encoded = 0;
        std::array<double, grids> encoded{};
        for (std::size_t i = 0; i < grids; ++i) {
            mean += sums_[at + i] / of_grid / grids;
            encoded[i] = encode(sums_[at + i] / of_grid);
            of_encoded += encoded[i] / grids;
        }
        for (const double value : encoded)
            sampling += (value - of_encoded) * (value - of_encoded) / (grids * (grids - 1));
        const double rounded =
            half_rounding(averaging_ == Averaging::linear ? mean : inverse(mean));
        rounding += rounded * rounded;
        found.pixels.push_back(encode(mean));
    }
    const auto count = static_cast<double>(std::max<std::size_t>(found.pixels.size(), 1));
    found.sampling_error = std::sqrt(sampling / count);
    found.rounding_error = std::sqrt(rounding / count);
    return found;
}

Combined combine(const Supersampled& a, const Supersampled& b) {
    Combined both{a, 0};
    double square = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        both.picture.pixels[i] = (a.pixels[i] + b.pixels[i]) / 2;
        square += (a.pixels[i] - b.pixels[i]) * (a.pixels[i] - b.pixels[i]) / 4;
    }
    both.order_error =
        std::sqrt(square / static_cast<double>(std::max<std::size_t>(a.pixels.size(), 1)));
    both.picture.sampling_error = std::hypot(a.sampling_error, b.sampling_error) / 2;
    both.picture.rounding_error = std::max(a.rounding_error, b.rounding_error);
    return both;
}

}  // namespace mpipov
