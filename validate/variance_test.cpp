#include "variance.h"

#include "noise_floor.h"
#include "pixel_scores.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

namespace mpipov {
namespace {

Welford of(const std::vector<double>& values) {
    Welford all;
    for (const double value : values) all.add(value);
    return all;
}

// So many values around 1e6 with a deviation of 1e-3, and what their variance is: steps of 2^-13
// are exact there, and the variance of the steps is a quotient of whole numbers.
struct FarFromZero {
    std::vector<double> values;
    double variance = 0;

    explicit FarFromZero(int count) {
        std::mt19937 random(1962);
        std::normal_distribution<double> deviation(0, 8);
        long long sum = 0, squares = 0;
        for (int i = 0; i < count; ++i) {
            const long long steps = std::llround(deviation(random));
            values.push_back(1e6 + static_cast<double>(steps) * 0x1p-13);
            sum += steps;
            squares += steps * steps;
        }
        const long long n = count;
        variance = static_cast<double>(n * squares - sum * sum) / static_cast<double>(n * (n - 1)) *
                   0x1p-26;
    }
};

constexpr double exactly = 1e-13;  // relative

TEST(Welford, MeanAndVariance) {
    const Welford all = of({1e9 + 4, 1e9 + 7, 1e9 + 13, 1e9 + 16});
    EXPECT_DOUBLE_EQ(all.mean(), 1e9 + 10);
    EXPECT_DOUBLE_EQ(all.variance(), 30);
    EXPECT_EQ(of({5}).variance(), 0);
    EXPECT_EQ(of({5}).mean(), 5);
    EXPECT_EQ(of({}).variance(), 0);
}

TEST(Welford, Mean1e6Deviation1e_3) {
    for (const int count : {2, 12, 1000, 100000}) {
        const FarFromZero far(count);
        EXPECT_NEAR(of(far.values).variance() / far.variance, 1, exactly) << count;
    }
}

TEST(Welford, InPartsOfAnySize) {
    const FarFromZero far(1000);
    std::mt19937 random(1983);
    for (int round = 0; round < 50; ++round) {
        Welford all;
        for (std::size_t from = 0; from < far.values.size();) {
            const auto most = far.values.size() - from;
            const auto count = std::min<std::size_t>(most, random() % 200);
            Welford part;
            for (std::size_t i = from; i < from + count; ++i) part.add(far.values[i]);
            all.add(part);
            from += count;
        }
        EXPECT_EQ(all.count(), 1000);
        EXPECT_NEAR(all.variance() / far.variance, 1, exactly);
    }
}

TEST(Welford, EqualValuesHaveNone) {
    for (const double value : {0.0, 0.1, 65504.0, 5.96e-8, 1e6, 3.4e38, 1e-45})
        EXPECT_EQ(of(std::vector<double>(17, value)).variance(), 0) << value;
}

TEST(Welford, WhatIsNotFiniteIsNoNumber) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {nan, infinity, -infinity})
        for (const auto& values :
             {std::vector{bad, 1.0, 2.0}, {1.0, bad, 2.0}, {1.0, 2.0, bad}, {bad, bad, bad}})
            EXPECT_FALSE(std::isfinite(of(values).variance()));
}

TEST(EachWithoutOne, IsThatOfTheOthers) {
    const std::vector<double> values{4, 7, 13, 16, -2};
    std::vector<Welford> rest;
    each_without_one(values, rest);
    ASSERT_EQ(rest.size(), 5U);
    for (std::size_t i = 0; i < values.size(); ++i) {
        std::vector<double> others = values;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        EXPECT_EQ(rest[i].count(), 4);
        EXPECT_NEAR(rest[i].mean(), of(others).mean(), 1e-13);
        EXPECT_NEAR(rest[i].variance(), of(others).variance(), 1e-12);
    }
}

TEST(EachWithoutOne, AnOutlierLeavesTheVarianceOfTheOthers) {
    FarFromZero far(11);
    far.values.insert(far.values.begin() + 4, 0);
    std::vector<Welford> rest;
    each_without_one(far.values, rest);
    EXPECT_NEAR(rest[4].variance() / far.variance, 1, exactly);
}

TEST(EachWithoutOne, WhatIsNotFiniteItselfIsNotJudged) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<Welford> rest;
    each_without_one(std::vector<double>{1, nan, 2}, rest);
    for (const Welford& one : rest) EXPECT_FALSE(std::isfinite(one.variance()));
}

// Where it is used: the noise floor and the scores of bright floats.
TEST(Variance, OfANoiseFloorFarFromZero) {
    const FarFromZero far(12);
    NoiseFloorBuilder builder({1, 1, 1});
    std::vector<std::span<const double>> renders;
    for (const double& value : far.values) renders.emplace_back(&value, 1);
    builder.add_row(0, renders);
    EXPECT_NEAR(*builder.result().sigma / std::sqrt(far.variance), 1, exactly);
}

TEST(Variance, OfPixelScoresBesideAnOutlier) {
    FarFromZero far(11);
    const double variance = far.variance;
    far.values.push_back(0);
    std::vector<std::span<const double>> renders;
    for (const double& value : far.values) renders.emplace_back(&value, 1);
    double sigma = 0;
    // Half-float steps are larger than the deviation, those of float are not.
    const Quantisation quantisation{Quantisation::Kind::float32};
    PixelScores scores({1, 1, 1}, quantisation, PixelScores::Judge::renders,
                       [&](const ScoreRow& row) {
                           if (row.render == 11) sigma = row.sigma[0];
                       });
    scores.add_row(0, renders, {});
    scores.finish();
    const double expected = (variance + quantisation.variance(1e6, 1e6)) * (1 + 1 / 11.0);
    EXPECT_NEAR(sigma / std::sqrt(expected), 1, 1e-9);
}

}  // namespace
}  // namespace mpipov
