#include "supersample.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mpipov {
namespace {

constexpr std::size_t channels = 3;
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

std::vector<double> Supersampled::encoded() const {
    std::vector<double> values = means;
    for (double& value : values)
        value = averaging == Averaging::linear ? srgb_encoded(value) : std::clamp(value, 0.0, 1.0);
    return values;
}

Supersampler::Supersampler(int width, int height, int factor, Averaging averaging)
    : picture_{width, height, factor, averaging,
               std::vector<double>(static_cast<std::size_t>(width) *
                                   static_cast<std::size_t>(height) * channels)} {}

void Supersampler::add_row(int y, std::span<const double> samples) {
    const auto factor = static_cast<std::size_t>(picture_.factor);
    const std::size_t row =
        static_cast<std::size_t>(y) / factor * static_cast<std::size_t>(picture_.width);
    const double weight = 1.0 / (picture_.factor * picture_.factor);
    for (std::size_t x = 0; x < samples.size() / channels; ++x) {
        double* means = &picture_.means[(row + x / factor) * channels];
        for (std::size_t c = 0; c < channels; ++c) {
            const double sample = samples[x * channels + c];
            if (!std::isfinite(sample)) continue;
            means[c] += weight * (picture_.averaging == Averaging::linear ? sample : curve(sample));
        }
    }
}

Supersampled Supersampler::result() const {
    return picture_;
}

Combined combine(const Supersampled& a, const Supersampled& b) {
    Combined both{a, 0, 0};
    const double of_a = a.factor * a.factor, of_b = b.factor * b.factor, all = of_a + of_b;
    const std::vector<double> encoded_a = a.encoded(), encoded_b = b.encoded();
    double square = 0, rounding = 0;
    for (std::size_t i = 0; i < a.means.size(); ++i) {
        const double mean = (of_a * a.means[i] + of_b * b.means[i]) / all;
        both.picture.means[i] = mean;
        square += (encoded_a[i] - encoded_b[i]) * (encoded_a[i] - encoded_b[i]);
        const double rounded =
            half_rounding(a.averaging == Averaging::linear ? mean : inverse(mean));
        rounding += rounded * rounded;
    }
    const auto count = static_cast<double>(std::max<std::size_t>(a.means.size(), 1));
    both.sampling_error = std::sqrt(of_a * of_b) / all * std::sqrt(square / count);
    both.rounding_error = std::sqrt(rounding / count);
    return both;
}

}  // namespace mpipov
