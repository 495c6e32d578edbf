// Idle ranks copy the section that would end last.
#include "coordinator_test_support.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <random>
#include <string>

namespace mpipov {
namespace {

RigSetup setup_with(unsigned seed) {
    RigSetup setup;
    setup.grid = {{0, 0, 120, 90}, Shape::tiles, Seams::plain, 12, 0, 32};
    setup.workers = 3;
    setup.copies = true;
    setup.clock_step = 0.05;
    setup.seed = seed;
    return setup;
}

TEST(CoordinatorCopies, ARankThatIsStuckHoldsNothingUp) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        RigSetup setup = setup_with(seed);
        setup.worker.stuck = [](int rank, const Assignment& a) {
            return rank == 2 && a.section.id > 2;
        };
        Rig rig(setup);
        rig.run();
        EXPECT_TRUE(holds_known_picture(rig.canvas(), setup.grid.region));
        const RunRecord record = rig.record();
        EXPECT_EQ(record.totals.copies, 1);
        EXPECT_EQ(record.totals.launches, 13);
        EXPECT_EQ(record.totals.retries, 0);
        for (const SectionRecord& section : record.sections) {
            EXPECT_FALSE(section.rank == 2 && section.section.id > 2);
            EXPECT_GE(section.end, section.start);
        }
    }
}

// Two launches of a section send bands and ends in any order, on a clock so slow that copies always
// seem to pay: the picture is whole whoever wins.
void expect_whole_pictures(const std::function<void(RigSetup&)>& change,
                           const std::function<void(const Totals&)>& check = {}) {
    int copies = 0;
    for (unsigned seed = 1; seed <= 200; ++seed) {
        RigSetup setup = setup_with(seed);
        setup.clock_step = 1;
        change(setup);
        Rig rig(setup);
        rig.run();
        EXPECT_TRUE(holds_known_picture(rig.canvas(), setup.grid.region));
        const Totals totals = rig.record().totals;
        copies += totals.copies;
        if (check) check(totals);
    }
    EXPECT_GT(copies, 20) << "nothing was tested";
}

TEST(CoordinatorCopies, TheFirstResultCountsInAnyOrderOfEvents) {
    expect_whole_pictures(
        [](RigSetup&) {},
        [](const Totals& totals) { EXPECT_EQ(totals.launches, 12 + totals.copies); });
}

TEST(CoordinatorCopies, AFailureOfEitherIsNoFailureOfTheSection) {
    expect_whole_pictures([](RigSetup& setup) {
        setup.retries = 1;
        setup.worker.fault = [](int, const Assignment& a) {
            return std::string(a.attempt == 1 && a.section.id % 3 == 0 ? "broken" : "");
        };
    });
}

// Without another attempt left: what is under way elsewhere may still come out well.
TEST(CoordinatorCopies, ACopyIsAnotherChance) {
    expect_whole_pictures([](RigSetup& setup) {
        setup.retries = 0;
        setup.worker.fault = [](int, const Assignment& a) {
            return std::string(a.attempt == 2 ? "at once" : "");
        };
    });
}

// The coordinator's clock goes back by days, or ahead, once or all the time: no section waits for
// it to come back, the one of a rank that is stuck neither, and no time is less than none.
TEST(CoordinatorClock, JumpsHoldNothingUp) {
    constexpr int most_steps = 200'000;
    for (unsigned seed = 1; seed <= 60; ++seed) {
        RigSetup setup = setup_with(seed);
        setup.worker.stuck = [](int rank, const Assignment& a) {
            return rank == 2 && a.section.id > 2;
        };
        auto looks = std::make_shared<int>(0);
        auto random = std::make_shared<std::mt19937>(seed);
        const double jump = seed % 2 == 0 ? -1e6 : 1e9;
        const bool again = seed % 3 == 0;
        setup.clock_jump = [=] {
            if (++*looks == 30) return jump;
            return again && (*random)() % 7 == 0 ? (*random)() % 2 == 0 ? -1e5 : 1e5 : 0.0;
        };
        Rig rig(setup);
        rig.coordinator().start();
        int steps = 0;
        while (!rig.coordinator().finished() && ++steps < most_steps) rig.step();
        ASSERT_TRUE(rig.coordinator().finished()) << "seed " << seed;
        EXPECT_TRUE(holds_known_picture(rig.canvas(), setup.grid.region));
        for (const SectionRecord& section : rig.record().sections)
            EXPECT_GE(section.end, section.start);
        for (const RankRecord& rank : rig.record().ranks) EXPECT_GE(rank.busy_seconds, 0);
    }
}

TEST(CoordinatorCopies, StaticAndHonestRanksMakeNone) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        RigSetup setup = setup_with(seed);
        setup.policy = Policy::static_;
        setup.clock_step = 1;
        Rig rig(setup);
        rig.run();
        EXPECT_EQ(rig.record().totals.copies, 0);
    }
}

}  // namespace
}  // namespace mpipov
