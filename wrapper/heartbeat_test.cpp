#include "heartbeat.h"

#include <gtest/gtest.h>

namespace mpipov {
namespace {

TEST(Heartbeat, NobodyIsLostWhoIsNotWatched) {
    const Heartbeat heartbeat(3, 15);
    EXPECT_FALSE(heartbeat.lost(1000));
}

TEST(Heartbeat, SilenceForTooLongIsALoss) {
    Heartbeat heartbeat(3, 15);
    heartbeat.watch(1, 100);
    heartbeat.watch(2, 100);
    EXPECT_FALSE(heartbeat.lost(114));
    heartbeat.heard(1, 114);
    EXPECT_EQ(heartbeat.lost(116), 2);
    heartbeat.heard(2, 116);
    EXPECT_FALSE(heartbeat.lost(117));
    EXPECT_EQ(heartbeat.lost(130), 1);
}

TEST(Heartbeat, WhoIsIgnoredMayBeSilent) {
    Heartbeat heartbeat(2, 15);
    heartbeat.watch(1, 0);
    heartbeat.ignore(1);
    EXPECT_FALSE(heartbeat.lost(100));
    heartbeat.watch(1, 100);
    EXPECT_FALSE(heartbeat.lost(110));
    EXPECT_EQ(heartbeat.lost(116), 1);
}

TEST(Heartbeat, APeerMayPromiseAnotherTime) {
    Heartbeat heartbeat(2, 15);
    heartbeat.watch(0, 0, 60);
    EXPECT_FALSE(heartbeat.lost(59));
    EXPECT_EQ(heartbeat.lost(61), 0);
}

TEST(Heartbeat, IsSaidOftenEnoughForSomeToComeLate) {
    Heartbeat heartbeat(2, 15);
    EXPECT_TRUE(heartbeat.due(0));
    EXPECT_FALSE(heartbeat.due(0));
    int said = 0;
    for (double now = 0; now <= 15; now += 0.1) said += heartbeat.due(now) ? 1 : 0;
    EXPECT_GE(said, 4);
    EXPECT_LE(said, 8);
}

}  // namespace
}  // namespace mpipov
