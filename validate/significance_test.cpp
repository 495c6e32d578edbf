#include "significance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace mpipov {
namespace {

TEST(Significance, SidakLeavesTheWholeAtAlpha) {
    EXPECT_DOUBLE_EQ(sidak(0.01, 1), 0.01);
    for (const double tests : {2.0, 21.0, 57600.0, 1e9})
        EXPECT_NEAR(std::exp(tests * std::log1p(-sidak(0.01, tests))), 0.99, 1e-9) << tests;
}

TEST(Significance, StudentsQuantilesAreThoseOfTheTables) {
    EXPECT_NEAR(t_quantile(0.025, 10), 2.228, 5e-4);
    EXPECT_NEAR(t_quantile(0.005, 4), 4.604, 5e-4);
    EXPECT_NEAR(t_quantile(0.05, 1), 6.314, 5e-4);
    EXPECT_THROW(t_quantile(0.05, 0), std::invalid_argument);
}

TEST(TailSample, KeepsTheLargestOfAll) {
    TailSample low, high;
    for (int i = 0; i < 500; ++i) low.add(i);
    for (int i = 0; i < 10; ++i) high.add(1000 + i);
    low.add(high);
    EXPECT_EQ(low.count(), 510);
    ASSERT_EQ(low.largest().size(), TailSample::kept);
    EXPECT_EQ(low.largest()[0], 1009);
    EXPECT_EQ(low.largest()[10], 499);
}

// Pareto's tail, P(X > x) = x^-4, at its exact quantiles.
TEST(CriticalValue, ExtendsAHeavyTailToWhatWasNotSeen) {
    constexpr int count = 100000;
    TailSample quiet;
    for (int i = 0; i < count; ++i) quiet.add(std::pow((i + 0.5) / count, -0.25));
    const double p = 1e-6;
    const double exact = std::pow(p, -0.25);
    EXPECT_GT(critical_value(quiet, p, 0), exact);
    EXPECT_LT(critical_value(quiet, p, 0), 2 * exact);
    EXPECT_EQ(critical_value(quiet, p, 1000), 1000);
}

// What it is for: of images like those that the tail was taken from, no more than alpha are called
// damaged. With the plain estimate instead of its upper end it is twice that.
TEST(CriticalValue, KeepsFalseAlarmsBelowTheSignificance) {
    constexpr int trials = 400, renders = 12, samples = 2000;
    constexpr double alpha = 0.01;
    std::mt19937 random(1999);
    std::uniform_real_distribution<double> uniform(1e-12, 1);
    const auto heavy = [&] { return std::pow(uniform(random), -0.2); };
    int alarms = 0;
    for (int trial = 0; trial < trials; ++trial) {
        TailSample quiet, image;
        for (int i = 0; i < renders * samples; ++i) quiet.add(heavy());
        for (int i = 0; i < samples; ++i) image.add(heavy());
        alarms += image.largest().front() > critical_value(quiet, sidak(alpha, samples), 0) ? 1 : 0;
    }
    EXPECT_LE(alarms, alpha * trials);
}

// Hill's estimate from the body of a distribution made a test of few values blind.
TEST(CriticalValue, OfFewValuesIsNoMoreThanTheirLargest) {
    TailSample quiet;
    for (int i = 1; i <= 117; ++i) quiet.add(i / 30.0);
    EXPECT_EQ(critical_value(quiet, 1e-4, 3.5), 117 / 30.0);
    EXPECT_EQ(critical_value(quiet, 1e-4, 5), 5);
}

TEST(CriticalValue, IsTheoreticalWithoutATail) {
    TailSample few, zeros;
    for (int i = 0; i < 7; ++i) few.add(100);
    for (int i = 0; i < 1000; ++i) zeros.add(0);
    EXPECT_EQ(critical_value(few, 0.01, 3), 3);
    EXPECT_EQ(critical_value(zeros, 0.01, 3), 3);
}

}  // namespace
}  // namespace mpipov
