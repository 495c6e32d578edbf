#include "tradeoff_front.h"

#include <gmock/gmock.h>

#include <cmath>

namespace mpipov {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Points = std::vector<std::optional<TradeoffPoint>>;

TEST(ParetoFront, IsSortedBySecondsAndLeavesOutWhatIsDominated) {
    const Points points{{{5, 0.5}}, {{1, 4}}, {{2, 2}}, {{3, 2.5}}, {{4, 2}}};
    EXPECT_THAT(pareto_front(points), ElementsAre(1, 2, 0));
}

TEST(ParetoFront, OfEqualErrorsTheFastestOfEqualTimesTheMostAccurate) {
    const Points equal_errors{{{2, 1}}, {{1, 1}}, {{3, 1}}};
    EXPECT_THAT(pareto_front(equal_errors), ElementsAre(1));
    const Points equal_times{{{2, 3}}, {{2, 1}}, {{2, 2}}};
    EXPECT_THAT(pareto_front(equal_times), ElementsAre(1));
    const Points all_equal{{{2, 3}}, {{2, 3}}};
    EXPECT_THAT(pareto_front(all_equal), ElementsAre(0));
}

TEST(ParetoFront, OfOneOrNoPoint) {
    EXPECT_THAT(pareto_front(Points{}), IsEmpty());
    EXPECT_THAT(pareto_front(Points{{}, {{1, 1}}, {}}), ElementsAre(1));
    EXPECT_THAT(pareto_front(Points{{}, {}}), IsEmpty());
}

TEST(Law, FindsThePowerThatThePointsFollow) {
    std::vector<TradeoffPoint> points;
    for (const double error : {8.0, 4.0, 1.0, 0.5})
        points.push_back({3 * std::pow(error, -1.5), error});
    const auto law = fit_law(points);
    ASSERT_TRUE(law);
    EXPECT_NEAR(law->exponent, 1.5, 1e-12);
    EXPECT_NEAR(law->factor, std::exp2(1.5), 1e-12);
    EXPECT_NEAR(law->scale, 3, 1e-12);
    EXPECT_NEAR(law->residual, 1, 1e-9);
    EXPECT_NEAR(law->from, 8, 1e-12);
    EXPECT_NEAR(law->to, 0.5, 1e-12);
    EXPECT_EQ(law->points, 4U);
}

// Seconds 1, 4, 4 at errors 4, 2, 1: slope of log2 over log2 is -1, residuals -1/3, 2/3, -1/3.
TEST(Law, SaysHowFarThePointsLieFromIt) {
    const std::vector<TradeoffPoint> points{{1, 4}, {4, 2}, {4, 1}};
    const auto law = fit_law(points);
    ASSERT_TRUE(law);
    EXPECT_NEAR(law->factor, 2, 1e-12);
    EXPECT_NEAR(law->residual, std::exp2(std::sqrt(2.0 / 9)), 1e-12);
}

TEST(Law, NeedsTwoDifferentErrorsAboveZero) {
    EXPECT_FALSE(fit_law({}));
    EXPECT_FALSE(fit_law(std::vector<TradeoffPoint>{{1, 2}}));
    EXPECT_FALSE(fit_law(std::vector<TradeoffPoint>{{1, 2}, {3, 2}}));
    EXPECT_FALSE(fit_law(std::vector<TradeoffPoint>{{1, 2}, {3, 0}}));
    EXPECT_TRUE(fit_law(std::vector<TradeoffPoint>{{1, 2}, {3, 1}, {9, 0}}));
}

// A front from 4.67 to 3.71 says nothing of what half of it would cost.
TEST(Law, NeedsAHalving) {
    EXPECT_FALSE(fit_law(std::vector<TradeoffPoint>{{1, 4.67}, {2, 4.0}, {4, 3.71}}));
    EXPECT_FALSE(fit_law(std::vector<TradeoffPoint>{{1, 2}, {4, 1.01}}));
    EXPECT_TRUE(fit_law(std::vector<TradeoffPoint>{{1, 2}, {4, 1}}));
}

TEST(Law, TheTruthsOwnErrorIsTakenOut) {
    const std::vector<TradeoffPoint> measured{{1, 5}, {2, 6}, {3, 5.9}, {4, 100}};
    const auto own = without_truths_error(measured, 3);
    ASSERT_EQ(own.size(), 2U);  // 5 and 5.9 are less than twice 3
    EXPECT_DOUBLE_EQ(own[0].error, std::sqrt(27.0));
    EXPECT_EQ(own[0].seconds, 2);
    EXPECT_DOUBLE_EQ(own[1].error, std::sqrt(10000.0 - 9));
    EXPECT_EQ(without_truths_error(measured, 0).size(), 4U);
    EXPECT_DOUBLE_EQ(without_truths_error(measured, 0)[0].error, 5);
}

TEST(Pick, CheapestWithinAnError) {
    const Points points{{{5, 0.5}}, {{1, 4}}, {}, {{2, 2}}, {{2, 1}}};
    EXPECT_EQ(cheapest_within(points, 2), 4U);  // as fast as 3, and more accurate
    EXPECT_EQ(cheapest_within(points, 0.5), 0U);
    EXPECT_EQ(cheapest_within(points, 100), 1U);
    EXPECT_FALSE(cheapest_within(points, 0.49));
}

TEST(Pick, MostAccurateWithinATime) {
    const Points points{{{5, 0.5}}, {{1, 4}}, {}, {{2, 2}}, {{4, 2}}};
    EXPECT_EQ(most_accurate_within(points, 4.5), 3U);  // as accurate as 4, and faster
    EXPECT_EQ(most_accurate_within(points, 5), 0U);
    EXPECT_EQ(most_accurate_within(points, 1), 1U);
    EXPECT_FALSE(most_accurate_within(points, 0.9));
}

}  // namespace
}  // namespace mpipov
