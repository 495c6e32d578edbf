#include "virtual_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace mpipov {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

constexpr double exact = 1e-9;

VirtualRun equal_sections(int count, double cpu, int ranks) {
    VirtualRun run;
    run.section_cpu.assign(static_cast<std::size_t>(count), cpu);
    run.ranks.resize(static_cast<std::size_t>(ranks));
    return run;
}

double sum(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(VirtualRun, EqualSectionsGoInRounds) {
    for (const Policy policy : {Policy::static_, Policy::dynamic, Policy::cost}) {
        for (const auto& [count, ranks, rounds] :
             {std::tuple{1, 1, 1}, {6, 3, 2}, {7, 3, 3}, {3, 5, 1}, {64, 64, 1}}) {
            VirtualRun run = equal_sections(count, 2, ranks);
            run.policy = policy;
            run.launch = {0.7, 0.06, 0, 0.1};
            const VirtualOutcome found = run_virtually(run);
            EXPECT_NEAR(found.wall_seconds, rounds * 2.86, exact) << count << " on " << ranks;
            EXPECT_EQ(found.launches, count);
            EXPECT_TRUE(found.terms_on.empty());
        }
    }
}

TEST(VirtualRun, SaysWhenAndWhereEachSectionWas) {
    VirtualRun run;
    run.section_cpu = {3, 1, 1};
    run.ranks.resize(2);
    run.terms.before = 10;
    run.terms.after = 5;
    const VirtualOutcome found = run_virtually(run);
    EXPECT_NEAR(found.wall_seconds, 18, exact);
    ASSERT_EQ(found.sections.size(), 3U);
    EXPECT_EQ(found.sections[2].rank, 1);
    EXPECT_NEAR(found.sections[2].start, 11, exact);
    EXPECT_NEAR(found.sections[2].end, 12, exact);
    EXPECT_EQ(found.ranks[1].launches, 2);
    EXPECT_NEAR(found.ranks[1].busy_seconds, 2, exact);
    EXPECT_NEAR(found.ranks[0].core_seconds, 3, exact);
    EXPECT_THAT(found.terms_on, ElementsAre("before", "after"));
}

// Longest first ends within 4/3 - 1/(3m) of the best (Graham 1969); this is the case where it does
// exactly that: 5,5,4,4,3,3,3 on three takes 11, and could take 9.
TEST(VirtualRun, LongestFirstIsAsGoodAndAsBadAsGrahamSays) {
    VirtualRun run;
    run.section_cpu = {3, 5, 4, 3, 5, 4, 3};
    run.ranks.resize(3);
    run.policy = Policy::cost;
    EXPECT_NEAR(run_virtually(run).wall_seconds, 11, exact);
    // In the order of the image the last long one is all that is left.
    run.section_cpu = {1, 1, 1, 1, 1, 1, 3};
    run.policy = Policy::dynamic;
    EXPECT_NEAR(run_virtually(run).wall_seconds, 5, exact);
    run.policy = Policy::cost;
    EXPECT_NEAR(run_virtually(run).wall_seconds, 3, exact);
    // What it was told wrongly it hands out wrongly.
    run.expected = {9, 9, 9, 9, 9, 9, 1};
    EXPECT_NEAR(run_virtually(run).wall_seconds, 5, exact);
}

TEST(VirtualRun, LaunchesInFlightHideTheIdleStart) {
    VirtualRun run = equal_sections(16, 0.04, 1);
    run.launch.idle_before = 0.7;
    EXPECT_NEAR(run_virtually(run).wall_seconds, 16 * 0.74, exact);
    // Four start at once and share the core; the next four start as soon as each ends.
    run.ranks[0].in_flight = 4;
    const VirtualOutcome found = run_virtually(run);
    EXPECT_NEAR(found.wall_seconds, 4 * (0.7 + 4 * 0.04), exact);
    EXPECT_NEAR(found.ranks[0].core_seconds, 0.64, exact);
    // Longer sections hide all but the first start-up and the last, where they are not all equal:
    // those begin and end together, and idle together.
    run.section_cpu.assign(16, 1);
    EXPECT_NEAR(run_virtually(run).wall_seconds, 4 * (0.7 + 4), exact);
    for (std::size_t i = 0; i < 16; ++i) run.section_cpu[i] = i % 4 == 0 ? 1.6 : 0.8;
    EXPECT_NEAR(run_virtually(run).wall_seconds, 0.7 + 16, 0.7);
}

TEST(VirtualRun, CoresAreSharedFairly) {
    // Two launches on a core: the shorter ends when both have had as much as it needs.
    VirtualRun run;
    run.section_cpu = {1, 3};
    run.ranks = {{1, 2, 1, 0}};
    const VirtualOutcome found = run_virtually(run);
    EXPECT_NEAR(found.sections[0].end, 2, exact);
    EXPECT_NEAR(found.sections[1].end, 4, exact);
}

TEST(VirtualRun, ThreadsShareAllButTheSerialPart) {
    VirtualRun run = equal_sections(1, 8, 1);
    run.ranks = {{4, 1, 1, 0}};
    run.launch = {0.5, 1, 4, 0.25};
    run.threads = 4;
    EXPECT_NEAR(run_virtually(run).wall_seconds, 0.5 + 1 + 3 + 0.25, exact);
    run.threads = 8;  // on four cores no more
    EXPECT_NEAR(run_virtually(run).wall_seconds, 0.5 + 1 + 3 + 0.25, exact);
    run.threads = 1;
    EXPECT_NEAR(run_virtually(run).wall_seconds, 0.5 + 1 + 12 + 0.25, exact);
}

TEST(VirtualRun, AFasterRankGetsMore) {
    VirtualRun run = equal_sections(4, 6, 2);
    run.ranks[1].speed = 3;
    const VirtualOutcome found = run_virtually(run);
    EXPECT_NEAR(found.wall_seconds, 6, exact);
    EXPECT_EQ(found.ranks[1].launches, 3);
    EXPECT_NEAR(found.ranks[1].core_seconds, 6, exact);
    run.policy = Policy::static_;
    EXPECT_NEAR(run_virtually(run).wall_seconds, 12, exact);
}

TEST(VirtualRun, ADedicatedCoordinatorRendersNothing) {
    VirtualRun run = equal_sections(8, 1, 5);
    run.ranks[0].slots = 0;
    run.terms.rank0_cpu_seconds = 100;  // it has a core of its own for that
    const VirtualOutcome found = run_virtually(run);
    EXPECT_NEAR(found.wall_seconds, 2, exact);
    EXPECT_EQ(found.ranks[0].launches, 0);
    run.ranks.resize(1);
    EXPECT_THROW(run_virtually(run), std::invalid_argument);
}

TEST(VirtualRun, TheCoordinatorCanBeTheBottleneck) {
    // 1000 sections of a hundredth on 100 ranks ask for 10 000 sections a second; it does 100.
    VirtualRun run = equal_sections(1000, 0.01, 100);
    run.terms.service_seconds = 0.01;
    const VirtualOutcome found = run_virtually(run);
    EXPECT_NEAR(found.wall_seconds, 10, 0.02);
    EXPECT_NEAR(found.rank0_service_seconds, 10, exact);
    EXPECT_THAT(found.terms_on, ElementsAre("service"));
}

TEST(VirtualRun, CoordinatingTakesFromTheCoreOfRankZero) {
    VirtualRun run = equal_sections(10, 1, 1);
    run.terms.rank0_cpu_seconds = 0.1;
    // All but the taking in of the last, after which nothing is rendered.
    EXPECT_NEAR(run_virtually(run).wall_seconds, 11 - 0.05, exact);
    run.ranks[0].slots = 2;  // the second core has the time
    EXPECT_NEAR(run_virtually(run).wall_seconds, 10, exact);
}

TEST(VirtualRun, AnswersAndTheNetworkTakeTheirTime) {
    VirtualRun run = equal_sections(4, 1, 3);
    run.ranks[0].slots = 0;
    run.terms.answer_seconds = 0.2;
    EXPECT_NEAR(run_virtually(run).wall_seconds, 2 * 1.2, exact);
    run.terms.answer_seconds.reset();
    run.terms.network = VirtualNetwork{0.25, 100, {50, 50, 50, 50}};
    // On one host there is no network.
    EXPECT_NEAR(run_virtually(run).wall_seconds, 2, exact);
    // Elsewhere: two ways, and the second rank's pixels wait for those of the first, from then on
    // the two are half a second apart.
    run.ranks[1].host = run.ranks[2].host = 1;
    const VirtualOutcome found = run_virtually(run);
    EXPECT_NEAR(found.wall_seconds, 2 * (0.25 + 1 + 0.5 + 0.25) + 0.5, exact);
    EXPECT_NEAR(found.link_seconds, 2, exact);
}

TEST(VirtualRun, IdleRanksCopyTheLastSectionOfASlowOne) {
    VirtualRun run = equal_sections(3, 4, 2);
    run.ranks[0].speed = 0.1;
    EXPECT_NEAR(run_virtually(run).wall_seconds, 40, exact);
    run.terms.copies = true;
    const VirtualOutcome found = run_virtually(run);
    EXPECT_NEAR(found.wall_seconds, 12, exact);
    EXPECT_EQ(found.copies, 1);
    EXPECT_EQ(found.launches, 4);
    EXPECT_EQ(found.sections[0].rank, 1);
    EXPECT_NEAR(found.ranks[0].busy_seconds, 12, exact);
    // Among equals nobody would have it earlier.
    run.ranks[0].speed = 1;
    EXPECT_EQ(run_virtually(run).copies, 0);
    // Nor with the policy of 1999.
    run.ranks[0].speed = 0.1;
    run.policy = Policy::static_;
    EXPECT_EQ(run_virtually(run).copies, 0);
}

TEST(VirtualRun, AnIdleRankTakesALaunchOffASharedCore) {
    VirtualRun run;
    run.section_cpu = {4, 1, 4};
    run.ranks = {{1, 2, 1, 0}, {1, 1, 1, 0}};
    // Rank 0 begins 0 and 2, which share its core until 8; rank 1 is free at 1.
    EXPECT_NEAR(run_virtually(run).wall_seconds, 8, exact);
    run.terms.copies = true;
    const VirtualOutcome found = run_virtually(run);
    EXPECT_EQ(found.copies, 1);
    // At 5 the copy is done; the other one had half a core for 5 seconds, and has it alone now.
    EXPECT_NEAR(found.wall_seconds, 6.5, exact);
}

TEST(VirtualRun, RefusesWhatCannotBe) {
    const auto refused = [](auto change) {
        VirtualRun run = equal_sections(2, 1, 2);
        change(run);
        EXPECT_THROW(run_virtually(run), std::invalid_argument);
    };
    refused([](VirtualRun& run) { run.ranks.clear(); });
    refused([](VirtualRun& run) { run.section_cpu[0] = -1; });
    refused([](VirtualRun& run) { run.section_cpu[0] = never; });
    refused([](VirtualRun& run) { run.ranks[0].speed = 0; });
    refused([](VirtualRun& run) { run.ranks[0].in_flight = 0; });
    refused([](VirtualRun& run) { run.threads = 0; });
    refused([](VirtualRun& run) { run.launch.idle_after = -1; });
    refused([](VirtualRun& run) { run.terms.network = VirtualNetwork{0, 1, {1}}; });
    refused([](VirtualRun& run) { run.terms.network = VirtualNetwork{0, 0, {}}; });
    refused([](VirtualRun& run) { run.expected = {1}; });
    EXPECT_NO_THROW(run_virtually(equal_sections(2, 1, 2)));
    EXPECT_EQ(run_virtually(equal_sections(0, 1, 2)).wall_seconds, 0);
}

VirtualRun random_run(std::mt19937& random) {
    const auto up_to = [&](double most) {
        return std::uniform_real_distribution<double>(0, most)(random);
    };
    const auto whole = [&](int least, int most) {
        return std::uniform_int_distribution<int>(least, most)(random);
    };
    VirtualRun run;
    run.policy = std::vector{Policy::static_, Policy::dynamic,
                             Policy::cost}[static_cast<std::size_t>(whole(0, 2))];
    for (int n = whole(1, 60); n > 0; --n) run.section_cpu.push_back(up_to(1) * up_to(10));
    for (int n = whole(1, 9); n > 0; --n)
        run.ranks.push_back(
            {whole(1, 4), whole(1, 6), whole(0, 1) ? 1.0 : 0.2 + up_to(3), whole(0, 2)});
    run.threads = whole(1, 5);
    run.launch = {up_to(1), up_to(0.5), up_to(0.5), up_to(0.1)};
    if (whole(0, 1)) run.terms.answer_seconds = up_to(0.1);
    if (whole(0, 1)) run.terms.service_seconds = up_to(0.1);
    if (whole(0, 1)) run.terms.rank0_cpu_seconds = up_to(0.1);
    if (whole(0, 1))
        run.terms.network = VirtualNetwork{up_to(0.01), 100 + up_to(1000),
                                           std::vector<double>(run.section_cpu.size(), up_to(9))};
    if (whole(0, 1)) run.terms.before = up_to(2);
    if (whole(0, 1)) run.terms.after = up_to(2);
    run.terms.copies = whole(0, 1) == 1;
    return run;
}

TEST(VirtualRun, NeverFasterThanItsCoresNorThanItsLongestSection) {
    std::mt19937 random(11);
    int with_copies = 0;
    for (int round = 0; round < 2000; ++round) {
        SCOPED_TRACE(round);
        const VirtualRun run = random_run(random);
        const VirtualOutcome found = run_virtually(run);
        const double count = static_cast<double>(run.section_cpu.size());
        const double cpu =
            sum(run.section_cpu) + count * (run.launch.serial_cpu + run.launch.parallel_cpu);
        double power = 0, fastest = 0, used = 0;
        int launches = 0;
        for (std::size_t i = 0; i < run.ranks.size(); ++i) {
            const VirtualRank& rank = run.ranks[i];
            const VirtualRankUse& use = found.ranks[i];
            power += rank.slots * rank.speed;
            fastest = std::max(fastest, std::min(run.threads, rank.slots) * rank.speed);
            used += use.core_seconds * rank.speed;
            launches += use.launches;
            EXPECT_LE(use.core_seconds, use.busy_seconds * rank.slots + exact);
            EXPECT_LE(use.busy_seconds, found.wall_seconds + exact);
        }
        const double longest =
            *std::max_element(run.section_cpu.begin(), run.section_cpu.end()) / fastest;
        const double fixed = run.terms.before.value_or(0) + run.terms.after.value_or(0);
        EXPECT_GE(found.wall_seconds, fixed + cpu / power - exact);
        EXPECT_GE(found.wall_seconds, fixed + run.launch.idle_before + longest - exact);
        EXPECT_EQ(launches, found.launches);
        EXPECT_EQ(found.launches, static_cast<int>(run.section_cpu.size()) + found.copies);
        // No work is lost, and none done that nobody asked for.
        if (found.copies == 0)
            EXPECT_THAT(used, DoubleNear(cpu, 1e-6));
        else
            EXPECT_GE(used, cpu - 1e-6);
        with_copies += found.copies > 0 ? 1 : 0;
        for (const VirtualSection& section : found.sections) {
            ASSERT_GE(section.rank, 0);
            EXPECT_LE(run.terms.before.value_or(0), section.start);
            EXPECT_LE(section.start, section.end);
            EXPECT_LE(section.end, found.wall_seconds);
        }
    }
    EXPECT_GT(with_copies, 50);
}

// Graham: whoever is free takes the next, so no core waits before the last section has begun.
TEST(VirtualRun, DynamicEndsWithinTheLongestSectionOfTheIdealTime) {
    std::mt19937 random(12);
    for (int round = 0; round < 500; ++round) {
        VirtualRun run = random_run(random);
        run.policy = Policy::dynamic;
        run.terms = {};
        run.threads = 1;
        run.launch = {};
        for (VirtualRank& rank : run.ranks) rank = {};
        const double ideal = sum(run.section_cpu) / static_cast<double>(run.ranks.size());
        const double longest = *std::max_element(run.section_cpu.begin(), run.section_cpu.end());
        EXPECT_LE(run_virtually(run).wall_seconds, ideal + longest + exact);
        run.policy = Policy::cost;
        EXPECT_LE(run_virtually(run).wall_seconds,
                  std::max(longest, ideal) * (4.0 / 3) + longest / 3 + exact);
    }
}

}  // namespace
}  // namespace mpipov
