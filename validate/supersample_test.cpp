#include "supersample.h"

#include "tradeoff_truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace mpipov {
namespace {

// One pixel of which every sample has the value of(x, y) in all channels.
template <class Of>
Supersampled one_pixel(int factor, Averaging averaging, const Of& of) {
    Supersampler sampler(1, 1, factor, averaging);
    for (int y = 0; y < factor; ++y) {
        std::vector<double> row;
        for (int x = 0; x < factor; ++x)
            for (int c = 0; c < 3; ++c) row.push_back(of(x, y));
        sampler.add_row(y, row);
    }
    return sampler.result();
}

TEST(Srgb, IsTheCurveOfTheStandard) {
    EXPECT_EQ(srgb_encoded(0), 0);
    EXPECT_NEAR(srgb_encoded(1), 1, 1e-12);
    EXPECT_NEAR(srgb_encoded(0.5), 0.735357, 1e-6);
    EXPECT_NEAR(srgb_encoded(0.001), 0.01292, 1e-9);
    EXPECT_EQ(srgb_encoded(7), 1);
    EXPECT_EQ(srgb_encoded(-1), 0);
}

TEST(Supersampler, AveragesBeforeItClips) {
    // Half of the samples at 1.6: in linear light the mean is 0.8.
    const auto stripes = [](int x, int) { return x % 4 < 2 ? 1.6 : 0.0; };
    EXPECT_NEAR(one_pixel(8, Averaging::linear, stripes).pixels[0], srgb_encoded(0.8), 1e-12);
    const auto half = [](int x, int) { return x % 4 < 2 ? 1.0 : 0.0; };
    EXPECT_NEAR(one_pixel(8, Averaging::linear, half).pixels[0], 0.735357, 1e-6);
    EXPECT_NEAR(one_pixel(8, Averaging::encoded, half).pixels[0], 0.5, 1e-9);
}

TEST(Supersampler, KeepsPixelsAndChannelsApart) {
    Supersampler sampler(2, 2, 2, Averaging::linear);
    for (int y = 0; y < 4; ++y) {
        std::vector<double> row;
        for (int x = 0; x < 4; ++x)
            for (int c = 0; c < 3; ++c)
                row.push_back(0.01 * (100 * (y / 2) / 2 + 10 * (x / 2) + c));
        sampler.add_row(y, row);
    }
    const Supersampled found = sampler.result();
    ASSERT_EQ(found.pixels.size(), 12U);
    EXPECT_NEAR(found.pixels[1], srgb_encoded(0.01), 1e-12);
    EXPECT_NEAR(found.pixels[3], srgb_encoded(0.10), 1e-12);
    EXPECT_NEAR(found.pixels[6], srgb_encoded(0.50), 1e-12);
    EXPECT_NEAR(found.pixels[11], srgb_encoded(0.62), 1e-12);
    EXPECT_NEAR(found.sampling_error, 0, 1e-12);
}

// Of independent samples the estimate must be the real error: here of many pixels, whose mean is
// known. Encoded averaging, so that no curve lies between.
TEST(Supersampler, KnowsItsOwnErrorOfRandomSamples) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> noise(0.01, 0.2);
    constexpr int width = 200, height = 20, factor = 8;
    Supersampler sampler(width, height, factor, Averaging::linear);
    for (int y = 0; y < height * factor; ++y) {
        std::vector<double> row(static_cast<std::size_t>(width) * factor * 3);
        for (double& value : row) value = noise(random);
        sampler.add_row(y, row);
    }
    const Supersampled found = sampler.result();
    const double truth = srgb_encoded(0.105);
    double square = 0;
    for (const double pixel : found.pixels) square += (pixel - truth) * (pixel - truth);
    const double error = std::sqrt(square / static_cast<double>(found.pixels.size()));
    EXPECT_NEAR(found.sampling_error / error, 1, 0.05);
}

TEST(Supersampler, CallsAnEdgesErrorRatherTooLarge) {
    constexpr int factor = 8;
    double real = 0, said = 0;
    for (int i = 0; i < 400; ++i) {  // an edge at any place and slope
        const double at = i / 400.0, slope = 0.1 + 0.8 * std::fmod(i * 0.618, 1.0);
        const auto cover = [&](int n) {
            return one_pixel(n, Averaging::linear, [&](int x, int y) {
                return (x + 0.5) / n + slope * ((y + 0.5) / n - 0.5) < at ? 0.5 : 0.2;
            });
        };
        const Supersampled found = cover(factor), exact = cover(128);
        real += std::pow(found.pixels[0] - exact.pixels[0], 2);
        said += std::pow(found.sampling_error, 2);
    }
    EXPECT_GT(std::sqrt(said / real), 1);
    EXPECT_LT(std::sqrt(said / real), 2.5);
}

TEST(Supersampler, LeavesOutWhatIsNotFinite) {
    const auto hole = [](int x, int y) {
        return x == 0 && y == 0 ? std::numeric_limits<double>::quiet_NaN() : 0.5;
    };
    EXPECT_NEAR(one_pixel(2, Averaging::linear, hole).pixels[0], srgb_encoded(0.375), 1e-12);
}

TEST(HalfRounding, IsThatOfTheHalfFormat) {
    // From 0.5 to 1 halfs are 2^-11 apart.
    const double slope = (srgb_encoded(0.7001) - srgb_encoded(0.6999)) / 0.0002;
    EXPECT_NEAR(half_rounding(0.7), std::ldexp(1, -11) / std::sqrt(12) * slope, 1e-9);
    EXPECT_EQ(half_rounding(0), 0);
    EXPECT_EQ(half_rounding(1.5), 0);  // clipped
}

TEST(Combine, HalvesTheDifference) {
    const Supersampled a{1, 1, {0.2, 0.4, 0.6}, 0.3, 0.01}, b{1, 1, {0.4, 0.4, 0.6}, 0.4, 0.02};
    const Combined both = combine(a, b);
    EXPECT_NEAR(both.picture.pixels[0], 0.3, 1e-12);
    EXPECT_NEAR(both.order_error, 0.1 / std::sqrt(3), 1e-12);
    EXPECT_NEAR(both.picture.sampling_error, 0.25, 1e-12);
    EXPECT_NEAR(both.picture.rounding_error, 0.02, 1e-12);
}

TEST(NextFactor, IsEvenAndBounded) {
    EXPECT_EQ(next_factor(8, 0.3, 0.1, 32), 24);
    EXPECT_EQ(next_factor(8, 0.31, 0.1, 32), 26);  // 24.8
    EXPECT_EQ(next_factor(8, 1, 0.1, 32), 32);
    EXPECT_EQ(next_factor(8, 1, 0.1, 31), 30);
    EXPECT_EQ(next_factor(8, 0.1001, 0.1, 32), 10);
    EXPECT_EQ(next_factor(8, 1, 0, 32), 32);
}

TEST(Truth, AddsUpItsErrors) {
    Truth truth;
    truth.sampling_error = 3;
    truth.order_error = 2;
    truth.rounding_error = 4;
    EXPECT_NEAR(truth.error(), 5, 1e-12);
    truth.order_error = 30;
    truth.rounding_error = 40;
    EXPECT_NEAR(truth.error(), 50, 1e-12);
}

}  // namespace
}  // namespace mpipov
