#include "coordinator.h"

#include "coordinator_test_support.h"
#include "failure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <set>
#include <stdexcept>
#include <tuple>

namespace mpipov {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr Rect frame{0, 0, 48, 36};

class EveryPixel : public testing::TestWithParam<std::tuple<Shape, Policy, Seams>> {};

TEST_P(EveryPixel, IsRightForAnyWorkersLaunchesAndRegion) {
    const auto [shape, policy, seams] = GetParam();
    for (const Rect& region : {frame, Rect{5, 3, 41, 31}})
        for (int workers = 1; workers <= 9; ++workers)
            for (int in_flight = 1; in_flight <= 4; ++in_flight) {
                RigSetup setup;
                const int halo = seams == Seams::halo ? (workers + in_flight) % 5 : 0;
                setup.grid = {region, shape, seams, 1, halo, 4};
                setup.grid.sections = static_cast<int>(
                    std::min<long long>(max_sections(setup.grid), 2 * workers + in_flight));
                setup.policy = policy;
                setup.workers = workers;
                setup.in_flight = in_flight;
                setup.frame_width = frame.x1;
                setup.frame_height = frame.y1;
                setup.seed = static_cast<unsigned>(workers * 10 + in_flight);
                Rig rig(setup);
                rig.run();
                ASSERT_TRUE(holds_known_picture(rig.canvas(), region))
                    << workers << " workers, " << in_flight << " in flight, halo " << halo;
                for (const FakeWorker& worker : rig.workers())
                    EXPECT_LE(worker.most_in_flight(), in_flight);
                const RunRecord record = rig.record();
                EXPECT_EQ(record.sections.size(), static_cast<std::size_t>(setup.grid.sections));
                EXPECT_EQ(record.totals.launches, setup.grid.sections);
                EXPECT_EQ(record.totals.retries, 0);
                for (const SeamRecord& seam : record.seams) {
                    EXPECT_EQ(seam.checked, halo >= 2);
                    EXPECT_EQ(seam.differing, 0);
                }
            }
}

INSTANTIATE_TEST_SUITE_P(
    Coordinator, EveryPixel,
    testing::Combine(testing::Values(Shape::columns, Shape::rows, Shape::tiles),
                     testing::Values(Policy::static_, Policy::dynamic),
                     testing::Values(Seams::aligned, Seams::halo, Seams::plain)),
    [](const auto& test) {
        return fmt::format("{}_{}_{}", to_string(std::get<0>(test.param)),
                           to_string(std::get<1>(test.param)), to_string(std::get<2>(test.param)));
    });

RigSetup columns(int sections, int workers) {
    RigSetup setup;
    setup.grid = {frame, Shape::columns, Seams::plain, sections, 0, 32};
    setup.workers = workers;
    return setup;
}

TEST(Coordinator, GivesADedicatedRankNothing) {
    for (const Policy policy : {Policy::static_, Policy::dynamic}) {
        RigSetup setup = columns(12, 3);
        setup.policy = policy;
        setup.dedicated_coordinator = true;
        Rig rig(setup);
        rig.run();
        EXPECT_TRUE(holds_known_picture(rig.canvas(), frame));
        EXPECT_TRUE(rig.workers()[0].assignments().empty());
        EXPECT_EQ(rig.record().ranks[0].sections, 0);
    }
}

TEST(Coordinator, FillsEveryRankBeforeAnyGetsASecondLaunch) {
    RigSetup setup = columns(4, 4);
    setup.in_flight = 4;
    Rig rig(setup);
    rig.run();
    for (const FakeWorker& worker : rig.workers()) EXPECT_EQ(worker.assignments().size(), 1u);
}

TEST(Coordinator, GivesAFailedSectionToAnotherWorker) {
    for (const Policy policy : {Policy::static_, Policy::dynamic}) {
        RigSetup setup = columns(12, 3);
        setup.policy = policy;
        setup.worker.fault = [](int rank, const Assignment&) {
            return rank == 1 ? std::string("a broken disk") : std::string();
        };
        Rig rig(setup);
        rig.run();
        EXPECT_TRUE(holds_known_picture(rig.canvas(), frame));
        const auto failed = static_cast<int>(rig.workers()[1].assignments().size());
        EXPECT_GT(failed, 0);
        const RunRecord record = rig.record();
        EXPECT_EQ(record.totals.retries, failed);
        EXPECT_EQ(record.totals.launches, 12 + failed);
        EXPECT_EQ(record.totals.cpu_seconds, 12 + failed) << "failed launches cost too";
        EXPECT_EQ(record.ranks[1].sections, 0);
        for (const SectionRecord& section : record.sections) {
            EXPECT_NE(section.rank, 1);
            EXPECT_EQ(section.host, fmt::format("host{}", section.rank));
            EXPECT_LE(section.attempts, 2);
        }
    }
}

TEST(Coordinator, TriesAgainOnTheOnlyWorker) {
    RigSetup setup = columns(3, 1);
    setup.worker.fault = [](int, const Assignment& a) {
        return a.section.id == 1 && a.attempt <= 2 ? std::string("busy") : std::string();
    };
    Rig rig(setup);
    rig.run();
    EXPECT_TRUE(holds_known_picture(rig.canvas(), frame));
    EXPECT_EQ(rig.record().sections[1].attempts, 3);
    EXPECT_EQ(rig.record().totals.retries, 2);
}

TEST(Coordinator, GivesUpAfterTheRetriesAndSaysWhy) {
    for (const int retries : {0, 1, 2, 5})
        for (const int workers : {1, 3}) {
            RigSetup setup = columns(4, workers);
            setup.retries = retries;
            setup.worker.fault = [](int, const Assignment& a) {
                return a.section.id == 2 ? std::string("Undeclared identifier 'x'") : std::string();
            };
            Rig rig(setup);
            try {
                rig.run();
                FAIL() << "a section that always fails went through";
            } catch (const Failure& failure) {
                EXPECT_EQ(failure.code(), Exit::scene);
                EXPECT_THAT(failure.what(), AllOf(HasSubstr("section 2"), HasSubstr("host"),
                                                  HasSubstr(fmt::format("{} times", retries + 1)),
                                                  HasSubstr("Undeclared identifier 'x'")));
            }
            int tries = 0;
            for (const FakeWorker& worker : rig.workers())
                for (const Assignment& a : worker.assignments()) tries += a.section.id == 2;
            EXPECT_EQ(tries, retries + 1);
        }
}

TEST(Coordinator, CountsInTheRecord) {
    RigSetup setup = columns(6, 2);
    Rig rig(setup);
    rig.run();
    const RunRecord record = rig.record();
    EXPECT_EQ(record.seams.size(), 5u);
    EXPECT_THAT(record.warnings, ElementsAre("the same warning"));
    int sections = 0;
    for (const RankRecord& rank : record.ranks) {
        sections += rank.sections;
        EXPECT_GT(rank.busy_seconds, 0);
    }
    EXPECT_EQ(sections, 6);
    for (const SectionRecord& section : record.sections) {
        EXPECT_LT(section.start, section.end);
        EXPECT_EQ(section.wall_seconds, 2);
        EXPECT_EQ(section.cpu_seconds, 1);
        EXPECT_EQ(section.attempts, 1);
        EXPECT_FALSE(section.resumed);
    }
    RunRecord with_probe;
    with_probe.totals.launches = 3;
    with_probe.warnings = {"the same warning"};
    rig.coordinator().fill(with_probe);
    EXPECT_EQ(with_probe.totals.launches, 9);
    EXPECT_THAT(with_probe.warnings, ElementsAre("the same warning"));
}

TEST(Coordinator, TheFractionFollowsTheLaunchesAndNeverFalls) {
    Rig rig(columns(4, 1));  // the fake worker stays where it is: messages are written by hand
    Coordinator& coordinator = rig.coordinator();
    coordinator.start();
    EXPECT_EQ(coordinator.fraction(), 0);
    const auto say = [&](MessageKind kind, int attempt, nlohmann::json head) {
        head["section"] = 0;
        head["attempt"] = attempt;
        coordinator.handle({kind, 0, std::move(head), {}});
    };
    say(MessageKind::progress, 1, {{"fraction", 0.5}});
    EXPECT_DOUBLE_EQ(coordinator.fraction(), 0.125);
    say(MessageKind::failed, 1, {{"why", "no"}, {"code", 3}, {"cpu_seconds", 0.0}});
    EXPECT_DOUBLE_EQ(coordinator.fraction(), 0.125);
    say(MessageKind::progress, 2, {{"fraction", 0.25}});
    EXPECT_DOUBLE_EQ(coordinator.fraction(), 0.125);
    say(MessageKind::progress, 2, {{"fraction", 0.75}});
    EXPECT_DOUBLE_EQ(coordinator.fraction(), 0.1875);
    EXPECT_THROW(say(MessageKind::progress, 2, {{"fraction", 17}}), std::runtime_error);
    say(MessageKind::progress, 2, {{"fraction", 1}});
    EXPECT_DOUBLE_EQ(coordinator.fraction(), 0.25);
    EXPECT_EQ(coordinator.sections_done(), 0);
    EXPECT_EQ(coordinator.sections_total(), 4);
}

void render_ten_thousand_sections(Seams seams, int halo) {
    RigSetup setup;
    setup.grid = {{0, 0, 600, 600}, Shape::tiles, seams, 10'000, halo, 32};
    setup.workers = 64;
    setup.in_flight = 2;
    setup.worker.band_rows = 100;
    const std::clock_t before = std::clock();
    Rig rig(setup);
    rig.run();
    const double cpu = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
    EXPECT_TRUE(holds_known_picture(rig.canvas(), setup.grid.region));
    EXPECT_EQ(rig.record().totals.launches, 10'000);
    // Linear work takes about a second; anything quadratic in the sections takes minutes.
    EXPECT_LT(cpu, 20);
    testing::Test::RecordProperty("cpu_seconds", fmt::format("{:.2f}", cpu));
}

TEST(Coordinator, TenThousandSectionsOnSixtyFourWorkers) {
    render_ten_thousand_sections(Seams::plain, 0);
}

TEST(Coordinator, TenThousandSectionsThatCheckTheirSeams) {
    render_ten_thousand_sections(Seams::halo, 2);
}

}  // namespace
}  // namespace mpipov
