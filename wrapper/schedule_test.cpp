#include "schedule.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <set>

namespace mpipov {
namespace {

std::vector<int> ids(int n) {
    std::vector<int> out(static_cast<std::size_t>(n));
    std::iota(out.begin(), out.end(), 0);
    return out;
}

std::vector<int> take_all(Schedule& schedule, int worker) {
    std::vector<int> taken;
    while (const auto section = schedule.next(worker)) taken.push_back(*section);
    return taken;
}

TEST(Schedule, StaticGivesEachWorkerItsOwn) {
    Schedule s(Policy::static_, ids(4), {1, 1, 1, 1});
    EXPECT_THAT(take_all(s, 2), testing::ElementsAre(2));
    EXPECT_THAT(take_all(s, 0), testing::ElementsAre(0));
    EXPECT_THAT(take_all(s, 3), testing::ElementsAre(3));
}

TEST(Schedule, StaticFollowsTheLanesAndSkipsADedicatedCoordinator) {
    Schedule s(Policy::static_, ids(6), {0, 2, 1});
    EXPECT_THAT(take_all(s, 0), testing::IsEmpty());
    EXPECT_THAT(take_all(s, 1), testing::ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(take_all(s, 2), testing::ElementsAre(4, 5));
}

TEST(Schedule, DynamicGivesTheNextToWhoeverAsks) {
    Schedule s(Policy::dynamic, ids(3), {1, 1});
    EXPECT_EQ(s.next(1), 0);
    EXPECT_EQ(s.next(1), 1);
    EXPECT_EQ(s.next(0), 2);
    EXPECT_EQ(s.next(0), std::nullopt);
}

TEST(Schedule, AFailedSectionGoesElsewhereFirst) {
    Schedule s(Policy::dynamic, ids(1), {1, 1});
    ASSERT_EQ(s.next(0), 0);
    s.failed(0, 0);
    EXPECT_EQ(s.next(0), std::nullopt);
    ASSERT_EQ(s.next(1), 0);
    s.failed(0, 1);
    EXPECT_EQ(s.next(0), 0) << "failed on all: anybody may try again";
    EXPECT_EQ(s.attempts(0), 3);
}

TEST(Schedule, AFailedStaticSectionIsTakenByAnotherWorker) {
    Schedule s(Policy::static_, ids(2), {1, 1});
    ASSERT_EQ(s.next(0), 0);
    s.failed(0, 0);
    EXPECT_THAT(take_all(s, 1), testing::ElementsAre(1, 0));
}

TEST(Schedule, CountsDownToTheEndAndTakesMore) {
    Schedule s(Policy::dynamic, ids(2), {2});
    take_all(s, 0);
    s.finished(0);
    EXPECT_FALSE(s.all_finished());
    s.add(7);
    s.finished(1);
    s.finished(1);
    EXPECT_EQ(s.unfinished(), 1);
    EXPECT_EQ(s.next(0), 7);
    s.finished(7);
    EXPECT_TRUE(s.all_finished());
    EXPECT_THROW(s.add(7), std::invalid_argument);
}

TEST(Schedule, NeverHandsOutWhatWasFinishedBefore) {
    for (const Policy policy : {Policy::static_, Policy::dynamic, Policy::cost}) {
        Schedule s(policy, ids(4), {1, 1});
        s.finished(0);
        s.finished(2);
        std::set<int> taken;
        for (int worker : {0, 1, 0, 1})
            if (const auto section = s.next(worker)) taken.insert(*section);
        EXPECT_EQ(taken, (std::set<int>{1, 3}));
    }
}

TEST(Schedule, RefusesToScheduleForNobody) {
    EXPECT_THROW(Schedule(Policy::dynamic, ids(2), {0, 0}), std::invalid_argument);
}

TEST(Schedule, EverySectionIsGivenOutOnceWhateverTheWorkers) {
    for (const Policy policy : {Policy::static_, Policy::dynamic})
        for (int workers = 1; workers <= 9; ++workers)
            for (int n : {1, 2, 7, 100}) {
                Schedule s(policy, ids(n), std::vector<int>(static_cast<std::size_t>(workers), 1));
                std::multiset<int> taken;
                bool more = true;
                while (more) {
                    more = false;
                    for (int w = 0; w < workers; ++w)
                        if (const auto section = s.next(w)) {
                            taken.insert(*section);
                            s.finished(*section);
                            more = true;
                        }
                }
                EXPECT_EQ(taken.size(), static_cast<std::size_t>(n));
                EXPECT_EQ(std::set<int>(taken.begin(), taken.end()).size(), taken.size());
                EXPECT_TRUE(s.all_finished());
            }
}

TEST(Schedule, CostGivesTheLongestFirst) {
    Schedule s(Policy::cost, ids(4), {1, 1}, {1, 5, 3, 5});
    EXPECT_EQ(s.next(1), 1) << "of equals the first";
    EXPECT_EQ(s.next(0), 3);
    s.expect(0, 4);
    EXPECT_THAT(take_all(s, 0), testing::ElementsAre(0, 2));
}

TEST(Schedule, CostWithoutCostsIsDynamic) {
    Schedule s(Policy::cost, ids(3), {1});
    EXPECT_THAT(take_all(s, 0), testing::ElementsAre(0, 1, 2));
    EXPECT_THROW(Schedule(Policy::cost, ids(3), {1}, {1, 2}), std::invalid_argument);
}

TEST(Schedule, AFailedSectionIsTakenBeforeLongerOnes) {
    Schedule s(Policy::cost, ids(3), {1, 1}, {1, 2, 3});
    ASSERT_EQ(s.next(0), 2);
    ASSERT_EQ(s.next(0), 1);
    s.failed(1, 0);
    EXPECT_EQ(s.next(1), 1);
}

TEST(Schedule, CopiesTheSectionThatWouldEndLastWhereThatPays) {
    Schedule s(Policy::dynamic, ids(3), {1, 1, 1, 1});
    for (int worker = 0; worker < 3; ++worker) ASSERT_EQ(s.next(worker), worker);
    ASSERT_EQ(s.next(3), std::nullopt);
    const auto outlook = [](int section) { return Outlook{10.0 * section, 15}; };
    EXPECT_EQ(s.next_copy(2, outlook), std::nullopt) << "its own, and others are nearer their end";
    EXPECT_EQ(s.next_copy(3, outlook), 2);
    EXPECT_EQ(s.attempts(2), 2);
    EXPECT_EQ(s.next_copy(0, outlook), std::nullopt) << "there are two of it already";
    s.finished(2);
    EXPECT_EQ(s.unfinished(), 2);
}

TEST(Schedule, ACopyOutlivesTheFailureOfItsOriginal) {
    Schedule s(Policy::dynamic, ids(1), {1, 1});
    ASSERT_EQ(s.next(0), 0);
    const auto outlook = [](int) { return Outlook{10, 1}; };
    ASSERT_EQ(s.next_copy(1, outlook), 0);
    s.failed(0, 0);
    EXPECT_EQ(s.next(1), std::nullopt) << "it is still under way";
    s.failed(0, 1);
    EXPECT_EQ(s.next(0), 0);
}

TEST(Schedule, StaticMakesNoCopies) {
    Schedule s(Policy::static_, ids(2), {1, 1});
    ASSERT_EQ(s.next(0), 0);
    EXPECT_EQ(s.next_copy(1, [](int) { return Outlook{10, 1}; }), std::nullopt);
}

}  // namespace
}  // namespace mpipov
