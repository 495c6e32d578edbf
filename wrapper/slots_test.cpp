#include "slots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace mpipov {
namespace {

using Masks = std::vector<std::vector<int>>;

TEST(Slots, OneRankHasAllItsCores) {
    EXPECT_EQ(fair_slots({{0, 1, 2, 3}}, 0), 4);
}

TEST(Slots, RanksThatAreBoundHaveTheirOwn) {
    const Masks masks{{0, 1}, {2}, {3, 4, 5}};
    EXPECT_EQ(fair_slots(masks, 0), 2);
    EXPECT_EQ(fair_slots(masks, 1), 1);
    EXPECT_EQ(fair_slots(masks, 2), 3);
}

TEST(Slots, TheFirstOfAMaskCouldUseAllOfIt) {
    const Masks masks{{0, 1}, {2, 3, 4}, {0, 1}, {2, 3, 4}};
    EXPECT_EQ(pooled_slots(masks, 0), 2);
    EXPECT_EQ(pooled_slots(masks, 1), 3);
    EXPECT_EQ(pooled_slots(masks, 2), 0);
    EXPECT_EQ(pooled_slots(masks, 3), 0);
}

TEST(Slots, WhatIsSharedIsUsedOnceAsAWhole) {
    for (int cores = 1; cores <= 9; ++cores)
        for (int ranks = 1; ranks <= cores; ++ranks) {
            std::vector<int> mask(static_cast<std::size_t>(cores));
            std::iota(mask.begin(), mask.end(), 0);
            const Masks masks(static_cast<std::size_t>(ranks), mask);
            int sum = 0, least = cores, most = 0;
            for (int rank = 0; rank < ranks; ++rank) {
                const int slots = fair_slots(masks, rank);
                sum += slots;
                least = std::min(least, slots);
                most = std::max(most, slots);
            }
            SCOPED_TRACE(testing::Message() << ranks << " ranks on " << cores << " cores");
            EXPECT_EQ(sum, cores);
            EXPECT_LE(most - least, 1);
        }
}

TEST(Slots, MoreRanksThanCoresHaveOneEach) {
    const Masks masks(5, {0, 1});
    for (int rank = 0; rank < 5; ++rank) EXPECT_EQ(fair_slots(masks, rank), 1);
}

TEST(Slots, OnlyTheSameMaskIsShared) {
    const Masks masks{{0, 1, 2, 3}, {4, 5}, {0, 1, 2, 3}};
    EXPECT_EQ(fair_slots(masks, 0), 2);
    EXPECT_EQ(fair_slots(masks, 1), 2);
    EXPECT_EQ(fair_slots(masks, 2), 2);
}

TEST(Slots, AnUnknownMaskStillMeansOne) {
    EXPECT_EQ(fair_slots({{}}, 0), 1);
    EXPECT_THROW(fair_slots({{0}}, 1), std::out_of_range);
}

TEST(SlotCpus, RanksKeepApartAsFarAsThereAreCores) {
    using Cpus = std::vector<int>;
    const Masks shared(3, {2, 3, 4, 5});
    EXPECT_EQ(slot_cpus(shared, 0, 2), (Cpus{2, 3}));
    EXPECT_EQ(slot_cpus(shared, 1, 2), (Cpus{4, 5}));
    EXPECT_EQ(slot_cpus(shared, 2, 2), (Cpus{2, 3})) << "none are left";
    EXPECT_EQ(slot_cpus(shared, 1, 3), (Cpus{5, 2, 3}));
    EXPECT_EQ(slot_cpus(shared, 1, 9), (Cpus{2, 3, 4, 5})) << "no more than there are";
    EXPECT_EQ(slot_cpus({{0, 1}, {2, 3}}, 1, 1), Cpus{2}) << "bound to other cores";
    EXPECT_TRUE(slot_cpus({{}}, 0, 1).empty());
}

}  // namespace
}  // namespace mpipov
