// Metrics against quadruple precision, on data that is meant to be hard to add up.
#include "exact_sums.h"
#include "noise_floor.h"
#include "seam_step.h"
#include "test_image.h"

#include <gmock/gmock.h>

#include <limits>
#include <numeric>
#include <random>
#include <thread>

namespace mpipov {
namespace {

constexpr double promised = 1e-12;
constexpr double half_largest = 65504, half_smallest = 0x1p-24;  // 5.96e-8, a subnormal
constexpr double float_largest = std::numeric_limits<float>::max();
constexpr double float_smallest = std::numeric_limits<float>::denorm_min();

struct Pair {
    const char* name = "";
    TestImage a, b;
};

template <typename Value>
Pair pair_of(const char* name, int width, int height, Value value) {
    Pair pair{name, {width, height, 3, {}}, {width, height, 3, {}}};
    const auto samples = static_cast<std::size_t>(width * height) * 3;
    for (std::size_t i = 0; i < samples; ++i) {
        const auto [a, b] = value(i);
        pair.a.values.push_back(a);
        pair.b.values.push_back(b);
    }
    return pair;
}

std::vector<Pair> hard_pairs() {
    std::mt19937 random(1965);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto as_float = [](double v) { return static_cast<double>(static_cast<float>(v)); };
    const int w = 211, h = 97;
    std::vector<Pair> pairs;
    pairs.push_back(pair_of("16 bits, ends of the range", w, h, [&](std::size_t i) {
        return i % 3 == 0 ? std::pair(0.0, 65535.0)
                          : std::pair(65535.0, i % 7 == 0 ? 65534.0 : 0.0);
    }));
    pairs.push_back(pair_of("half, largest and subnormal", w, h, [&](std::size_t i) {
        return i % 1000 == 7 ? std::pair(half_largest, -half_largest)
                             : std::pair(0.0, half_smallest * static_cast<double>(i % 5));
    }));
    pairs.push_back(pair_of("float, largest and denormal", w, h, [&](std::size_t i) {
        return i % 997 == 5 ? std::pair(-float_largest, float_largest)
                            : std::pair(float_smallest, 3 * float_smallest);
    }));
    pairs.push_back(pair_of("float, denormals alone", w, h, [&](std::size_t i) {
        return std::pair(0.0, float_smallest * static_cast<double>(1 + i % 9));
    }));
    // Each error is followed by nearly its opposite: of the sum next to nothing is left.
    double last = 0;
    pairs.push_back(pair_of("errors that cancel", w, h, [&](std::size_t i) {
        const double error =
            i % 2 == 0 ? as_float(1e6 * unit(random)) : as_float(-last * (1 + 1e-7 * unit(random)));
        last = error;
        return std::pair(0.0, error);
    }));
    pairs.push_back(pair_of("forty orders of magnitude", w, h, [&](std::size_t) {
        return std::pair(as_float(unit(random) * std::pow(10, 19 * unit(random))),
                         as_float(unit(random) * std::pow(10, 19 * unit(random))));
    }));
    pairs.push_back(pair_of("one huge, then tiny ones", w, h, [&](std::size_t i) {
        return std::pair(0.0, i == 0 ? 1e30 : as_float(1e-6 * unit(random)));
    }));
    return pairs;
}

QuadSums exact(const Pair& pair) {
    QuadSums sums;
    for (std::size_t i = 0; i < pair.a.values.size(); ++i)
        sums.add(pair.a.values[i], pair.b.values[i]);
    return sums;
}

TEST(MetricsPrecision, AgainstQuadruplePrecision) {
    for (const Pair& pair : hard_pairs()) {
        SCOPED_TRACE(pair.name);
        const Metrics metrics = measure(pair.a, pair.b);
        const QuadSums truth = exact(pair);
        ASSERT_EQ(metrics.all.samples(), truth.samples);
        const Inaccuracy off(metrics.all, truth);
        EXPECT_LT(off.mean_abs, promised);
        EXPECT_LT(off.mean_signed, promised);
        EXPECT_LT(off.rms, promised);
        EXPECT_NEAR(*metrics.psnr(1), 20 * std::log10(1 / truth.rms()), 1e-9);
    }
}

TEST(MetricsPrecision, PlainSumsWouldNotDo) {
    // 1e16 + 1 is 1e16: where half of the sum is in ones, plain addition loses half.
    ErrorSums errors;
    double plain = 0;
    const auto add = [&](double error) {
        errors.add(0, error);
        plain += error;
    };
    add(1e16);
    for (int i = 0; i < 1'000'000; ++i) add(1);
    EXPECT_EQ(plain, 1e16);
    EXPECT_EQ(*errors.mean_abs() * 1'000'001, 1e16 + 1e6);
}

// Any tiles, added in any order, on any number of threads.
TEST(MetricsPrecision, InTilesOfAnyOrderOnAnyNumberOfThreads) {
    std::mt19937 random(1974);
    for (const Pair& pair : hard_pairs()) {
        SCOPED_TRACE(pair.name);
        const QuadSums truth = exact(pair);
        for (int round = 0; round < 6; ++round) {
            std::vector<Rect> tiles;
            const int tile_width = 1 + static_cast<int>(random() % 120);
            const int tile_height = 1 + static_cast<int>(random() % 60);
            const Rect all{0, 0, pair.a.width, pair.a.height};
            for (int y = 0; y < all.y1; y += tile_height)
                for (int x = 0; x < all.x1; x += tile_width)
                    tiles.push_back(intersect({x, y, x + tile_width, y + tile_height}, all));
            std::shuffle(tiles.begin(), tiles.end(), random);
            const std::size_t threads = 1 + random() % 5;
            std::vector<ErrorSums> parts(threads);
            {
                std::vector<std::jthread> workers;
                for (std::size_t t = 0; t < threads; ++t)
                    workers.emplace_back([&, t] {
                        for (std::size_t i = t; i < tiles.size(); i += threads)
                            for (int y = tiles[i].y0; y < tiles[i].y1; ++y)
                                for (int s = tiles[i].x0 * 3; s < tiles[i].x1 * 3; ++s)
                                    parts[t].add(pair.a.row(y)[static_cast<std::size_t>(s)],
                                                 pair.b.row(y)[static_cast<std::size_t>(s)]);
                    });
            }
            std::shuffle(parts.begin(), parts.end(), random);
            ErrorSums sum;
            for (const ErrorSums& part : parts) sum.add(part);
            ASSERT_EQ(sum.samples(), truth.samples);
            EXPECT_LT(Inaccuracy(sum, truth).worst(), promised) << threads << " threads";
            EXPECT_EQ(sum.max(), measure(pair.a, pair.b).all.max());
        }
    }
}

TEST(MetricsPrecision, PartsOfTwoToThe31SamplesAndMore) {
    ErrorSums part;
    part.add_equal((1LL << 31) - 1);
    part.add(0, 65535);
    ErrorSums all;
    for (int i = 0; i < 5; ++i) all.add(part);
    EXPECT_EQ(all.samples(), 5LL << 31);
    EXPECT_DOUBLE_EQ(*all.mean_abs(), 65535.0 / (1LL << 31));
    EXPECT_DOUBLE_EQ(*all.rms(), 65535.0 / std::sqrt(0x1p31));
}

TEST(MetricsPrecision, TheSmallestAndTheLargestErrors) {
    const auto rms_of = [](double a, double b) {
        ErrorSums errors;
        errors.add(a, b);
        return errors.rms();
    };
    EXPECT_EQ(rms_of(0, half_smallest), half_smallest);
    EXPECT_EQ(rms_of(0, float_smallest), float_smallest);
    EXPECT_DOUBLE_EQ(*rms_of(-float_largest, float_largest), 2 * float_largest);
    // Doubles only: the square is none.
    EXPECT_FALSE(rms_of(0, 1e200));
    Metrics metrics;
    metrics.all.add(0, 1e200);
    EXPECT_FALSE(metrics.psnr(1));
    EXPECT_THAT(std::string(metrics.why_no_psnr()), testing::StartsWith("undefined"));
}

// Of 16 bits and of floats from end to end, with what is not finite among them.
TEST(MetricsPrecision, NoiseAndStepsOfExtremeSamples) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    const std::vector<double> a{0, 65535, -float_largest, float_smallest, nan, infinity, 7, 7},
        b{65535, 65535, float_largest, 0, nan, infinity, infinity, 7};
    NoiseFloorBuilder noise({8, 1, 1});
    const std::vector<std::span<const double>> renders{a, b};
    noise.add_row(0, renders);
    const NoiseFloor floor = noise.result();
    EXPECT_EQ(floor.samples, 5);
    EXPECT_EQ(floor.noisy, 3);
    EXPECT_EQ(floor.x, 2);
    EXPECT_DOUBLE_EQ(floor.largest_sigma, std::sqrt(2.0) * float_largest);
    EXPECT_TRUE(std::isfinite(*floor.sigma));

    StepBuilder step({0, 1, true, 4, 0, 1}, {0, 0, 4, 1}, {4, 0, 8, 1}, {8, 1, 1});
    step.add_row(0, a, b);
    const LineStep found = step.result();
    ASSERT_TRUE(found.mean_step);
    EXPECT_DOUBLE_EQ(*found.mean_step, (65535 + 2 * float_largest - float_smallest) / 4);
}

}  // namespace
}  // namespace mpipov
