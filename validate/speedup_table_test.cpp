#include "speedup_table.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <set>

namespace mpipov {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;

TEST(SpeedupTable, MedianAndSpread) {
    EXPECT_FALSE(spread_of({}));
    EXPECT_DOUBLE_EQ(spread_of({7})->median, 7);
    const Spread odd = *spread_of({5, 1, 2});
    EXPECT_THAT((std::vector{odd.low, odd.median, odd.high}), ElementsAre(1, 2, 5));
    const Spread even = *spread_of({8, 1, 2, 4});
    EXPECT_THAT((std::vector{even.low, even.median, even.high}), ElementsAre(1, 3, 8));
}

TEST(SpeedupTable, SpeedUpIsOfMediansAndItsSpreadOfPairs) {
    const Spread found = *speed_up({10.0, 12.0, 11.0}, {5.0, 4.0, 5.5});
    EXPECT_DOUBLE_EQ(found.median, 11.0 / 5.0);
    EXPECT_DOUBLE_EQ(found.low, 2);
    EXPECT_DOUBLE_EQ(found.high, 3);
    EXPECT_DOUBLE_EQ(*efficiency(found, 2), 1.1);
    EXPECT_FALSE(efficiency({}, 2));
}

TEST(SpeedupTable, SerialIsAsFastAsItself) {
    const Times times{3.0, 8.0, 1.0};
    const Spread found = *speed_up(times, times);
    EXPECT_THAT((std::vector{found.low, found.median, found.high}), ElementsAre(1, 1, 1));
}

TEST(SpeedupTable, OnlyRepetitionsWithBothCount) {
    EXPECT_FALSE(speed_up({10.0}, {}));
    EXPECT_FALSE(speed_up({10.0}, {std::nullopt}));
    EXPECT_FALSE(speed_up({10.0}, {0.0}));
    // A slow second half that the variant did not live to see says nothing of it.
    const Spread found = *speed_up({10.0, 30.0, 30.0}, {5.0, std::nullopt});
    EXPECT_THAT((std::vector{found.low, found.median, found.high}),
                ElementsAre(DoubleEq(2), DoubleEq(2), DoubleEq(2)));
    EXPECT_THAT(measured({1.0, std::nullopt, 2.0}), ElementsAre(1, 2));
}

TEST(SpeedupTable, TheMedianLiesWithinTheSpread) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> seconds(1, 9);
    for (int round = 0; round < 1000; ++round) {
        Times serial, times;
        for (int i = 0; i <= round % 9; ++i) {
            serial.emplace_back(seconds(random));
            times.emplace_back(seconds(random));
        }
        const Spread found = *speed_up(serial, times);
        EXPECT_LE(found.low, found.median * (1 + 1e-12));
        EXPECT_GE(found.high, found.median * (1 - 1e-12));
    }
}

TEST(SpeedupTable, TheOrderIsRotatedEvenly) {
    EXPECT_THAT(run_order(4, 0, 2), ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(run_order(4, 1, 2), ElementsAre(2, 3, 0, 1));
    EXPECT_THAT(run_order(3, 1, 9), ElementsAre(1, 2, 0));
    EXPECT_THAT(run_order(3, 4, 9), ElementsAre(1, 2, 0));
    EXPECT_THAT(run_order(1, 5, 9), ElementsAre(0));
    EXPECT_TRUE(run_order(0, 0, 1).empty());
}

TEST(SpeedupTable, EveryOrderRunsEachOnceAndDiffersFromTheLast) {
    for (std::size_t count = 2; count < 14; ++count)
        for (int repetitions = 2; repetitions < 20; ++repetitions) {
            std::set<std::size_t> first;
            std::vector<std::size_t> last;
            for (int i = 0; i < repetitions; ++i) {
                std::vector<std::size_t> order = run_order(count, i, repetitions);
                EXPECT_NE(order, last);
                first.insert(order.front());
                last = order;
                std::sort(order.begin(), order.end());
                for (std::size_t k = 0; k < count; ++k) EXPECT_EQ(order[k], k);
            }
            EXPECT_EQ(first.size(), std::min(count, static_cast<std::size_t>(repetitions)));
        }
}

}  // namespace
}  // namespace mpipov
