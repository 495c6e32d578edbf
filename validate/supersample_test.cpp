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
    EXPECT_NEAR(one_pixel(8, Averaging::linear, stripes).encoded()[0], srgb_encoded(0.8), 1e-12);
    const auto half = [](int x, int) { return x % 4 < 2 ? 1.0 : 0.0; };
    EXPECT_NEAR(one_pixel(8, Averaging::linear, half).encoded()[0], 0.735357, 1e-6);
    EXPECT_NEAR(one_pixel(8, Averaging::encoded, half).encoded()[0], 0.5, 1e-9);
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
    ASSERT_EQ(found.means.size(), 12U);
    EXPECT_NEAR(found.means[1], 0.01, 1e-12);
    EXPECT_NEAR(found.means[3], 0.10, 1e-12);
    EXPECT_NEAR(found.means[6], 0.50, 1e-12);
    EXPECT_NEAR(found.means[11], 0.62, 1e-12);
}

Supersampled noise(int factor, std::mt19937& random) {
    constexpr int width = 200, height = 20;
    std::uniform_real_distribution<double> samples(0.01, 0.2);
    Supersampler sampler(width, height, factor, Averaging::linear);
    for (int y = 0; y < height * factor; ++y) {
        std::vector<double> row(static_cast<std::size_t>(width * factor) * 3);
        for (double& value : row) value = samples(random);
        sampler.add_row(y, row);
    }
    return sampler.result();
}

double rms_from(const Supersampled& picture, double truth) {
    double square = 0;
    for (const double pixel : picture.encoded()) square += (pixel - truth) * (pixel - truth);
    return std::sqrt(square / static_cast<double>(picture.means.size()));
}

// Of independent samples the estimate must be the real error.
TEST(Combine, KnowsItsOwnErrorOfRandomSamples) {
    std::mt19937 random(7);
    const Supersampled a = noise(8, random), b = noise(10, random);
    const Combined both = combine(a, b);
    EXPECT_NEAR(both.sampling_error / rms_from(both.picture, srgb_encoded(0.105)), 1, 0.05);
}

TEST(Combine, KnowsItsOwnErrorOfEdges) {
    const auto edge = [](int n, double at, double slope) {
        return one_pixel(n, Averaging::linear, [&](int x, int y) {
            return (x + 0.5) / n + slope * ((y + 0.5) / n - 0.5) < at ? 0.5 : 0.2;
        });
    };
    double real = 0, said = 0;
    for (int i = 0; i < 400; ++i) {  // at any place and slope
        const double at = i / 400.0, slope = 0.1 + 0.8 * std::fmod(i * 0.618, 1.0);
        const Combined found = combine(edge(8, at, slope), edge(10, at, slope));
        real += std::pow(found.picture.encoded()[0] - edge(160, at, slope).encoded()[0], 2);
        said += std::pow(found.sampling_error, 2);
    }
    EXPECT_NEAR(std::sqrt(said / real), 1, 0.2);
}

TEST(Supersampler, LeavesOutWhatIsNotFinite) {
    const auto hole = [](int x, int y) {
        return x == 0 && y == 0 ? std::numeric_limits<double>::quiet_NaN() : 0.5;
    };
    EXPECT_NEAR(one_pixel(2, Averaging::linear, hole).encoded()[0], srgb_encoded(0.375), 1e-12);
}

TEST(HalfRounding, IsThatOfTheHalfFormat) {
    // From 0.5 to 1 halfs are 2^-11 apart.
    const double slope = (srgb_encoded(0.7001) - srgb_encoded(0.6999)) / 0.0002;
    EXPECT_NEAR(half_rounding(0.7), std::ldexp(1, -11) / std::sqrt(12) * slope, 1e-9);
    EXPECT_EQ(half_rounding(0), 0);
    EXPECT_EQ(half_rounding(1.5), 0);  // clipped
}

TEST(Combine, WeighsByTheNumberOfSamples) {
    const Supersampled a{1, 1, 8, Averaging::encoded, {0.2, 0.4, 0.6}};
    const Supersampled b{1, 1, 10, Averaging::encoded, {0.4, 0.4, 0.6}};
    const Combined both = combine(a, b);
    EXPECT_NEAR(both.picture.means[0], (64 * 0.2 + 100 * 0.4) / 164, 1e-12);
    EXPECT_NEAR(both.picture.means[2], 0.6, 1e-12);
    EXPECT_NEAR(both.sampling_error, 80.0 / 164 * 0.2 / std::sqrt(3), 1e-12);
}

TEST(Truth, CountsItsSamplesAndAddsUpItsErrors) {
    Truth truth;
    truth.depth = 1;
    EXPECT_EQ(truth.samples(), 164);
    truth.depth = 3;
    EXPECT_EQ(truth.samples(), 1640);
    truth.sampling_error = 3;
    truth.rounding_error = 4;
    EXPECT_NEAR(truth.error(), 5, 1e-12);
}

TEST(NextDepth, TakesAsManySamplesAsRandomOnesNeed) {
    EXPECT_EQ(next_depth(1, 0.3, 0.1, 9), 3);  // 10 times the samples: enough for a 3.16th
    EXPECT_EQ(next_depth(1, 0.32, 0.1, 9), 4);
    EXPECT_EQ(next_depth(2, 0.2, 0.19, 9), 3);
    EXPECT_EQ(next_depth(1, 9, 0.1, 5), 5);
    EXPECT_EQ(next_depth(5, 9, 0.1, 5), 5);
    EXPECT_EQ(next_depth(5, 9, 0.1, 0), 5);
}

TEST(DeepestWithin, HoldsBothLimits) {
    Truth known;
    known.depth = 1;
    known.wall_seconds = 2;
    EXPECT_EQ(deepest_within(100000, 1e9, known), 9);
    EXPECT_EQ(deepest_within(1640, 1e9, known), 3);
    EXPECT_EQ(deepest_within(1639, 1e9, known), 2);
    EXPECT_EQ(deepest_within(100000, 20, known), 3);
    EXPECT_EQ(deepest_within(100000, 1, known), 0);
}

}  // namespace
}  // namespace mpipov
