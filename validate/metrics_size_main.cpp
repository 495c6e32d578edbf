// The metrics of images of any size against quadruple precision, by hand: docs/arithmetic.md.
//
//     metrics_size WIDTH HEIGHT CHANNELS
//
// Makes two images row by row, of errors of ten orders of magnitude that nearly cancel, and prints
// how far off the metrics are; 1 where that is more than what metrics.h promises.
#include "exact_sums.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

namespace {

using namespace mpipov;

constexpr double promised = 1e-12;

// SplitMix64: a number for every place, so that rows can be made in any order.
std::uint64_t random_at(std::uint64_t place) {
    std::uint64_t z = place * 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
}

void make_row(std::uint64_t first, std::vector<double>& a, std::vector<double>& b) {
    constexpr double two_to_minus_32 = 0x1p-32;
    constexpr int smallest_exponent = -20, exponents = 34;
    double last = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const std::uint64_t bits = random_at(first + i);
        const double share = static_cast<double>(bits >> 32U) * two_to_minus_32;
        const int exponent = smallest_exponent + static_cast<int>(bits % exponents);
        const double error = i % 2 == 0 ? std::ldexp(share, exponent) : -last * (1 - 1e-6 * share);
        a[i] = static_cast<float>(share);
        b[i] = static_cast<float>(share + error);
        last = error;
    }
}

int run(int width, int height, int channels) {
    const auto begin = std::chrono::steady_clock::now();
    const auto samples = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
    std::vector<double> a(samples), b(samples);
    MetricsBuilder builder({width, height, channels});
    QuadSums exact;
    std::chrono::duration<double> adding{};
    for (int y = 0; y < height; ++y) {
        make_row(static_cast<std::uint64_t>(y) * samples, a, b);
        const auto before = std::chrono::steady_clock::now();
        builder.add_row(y, a, b);
        adding += std::chrono::steady_clock::now() - before;
        for (std::size_t i = 0; i < samples; ++i) exact.add(a[i], b[i]);
    }
    const Metrics metrics = builder.result();
    const Inaccuracy off(metrics.all, exact);
    const std::chrono::duration<double> all = std::chrono::steady_clock::now() - begin;
    fmt::print(
        "{} x {} x {}: {} samples; mean_abs {:.6g}, mean_signed {:.6g}, RMS {:.6g}\n"
        "off by {:.2g} (mean_abs), {:.2g} of mean_abs (mean_signed), {:.2g} (RMS); {:.0f} s, of "
        "these {:.0f} s for the metrics\n",
        width, height, channels, metrics.all.samples(), *metrics.all.mean_abs(),
        *metrics.all.mean_signed(), *metrics.all.rms(), off.mean_abs, off.mean_signed, off.rms,
        all.count(), adding.count());
    return metrics.all.samples() == exact.samples && off.worst() < promised ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc == 4) return run(std::stoi(argv[1]), std::stoi(argv[2]), std::stoi(argv[3]));
    } catch (const std::exception& error) {
        fmt::print(stderr, "metrics_size: {}\n", error.what());
    }
    fmt::print(stderr, "metrics_size WIDTH HEIGHT CHANNELS\n");
    return 2;
}
