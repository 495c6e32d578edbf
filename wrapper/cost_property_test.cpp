// Costs of any size: maps of them, cutting by them, the cost model.
#include "cost_cut.h"
#include "cost_model.h"
#include "partition_test_support.h"
#include "scene_plan.h"

#include <gmock/gmock.h>

#include <cmath>

namespace mpipov {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

double wild_seconds(Random& random) {
    return random.one_of(std::vector{0.0, 5e-324, 1e-300, 1e-9, 0.3, 1.0, 1.0, 40.0, 1e12, 1e300});
}

CostMap wild_costs(Random& random, const Rect& region) {
    GridRequest grid{region, Shape::tiles, Seams::plain, 1, 0, 32};
    grid.sections = random.between(1, static_cast<int>(std::min(60LL, max_sections(grid))));
    std::vector<CostPatch> patches;
    for (const Section& section : make_partition(grid).sections)
        if (!random.one_in(10)) patches.push_back({section.keep, wild_seconds(random)});
    return {region, std::move(patches)};
}

TEST(CostProperty, CutByCostIsSound) {
    for_rounds(400, [](Random& random) {
        RandomGrid grid = random_grid(random);
        while (grid.request.region.area() > 4'000'000) grid = random_grid(random);
        const CostMap costs = wild_costs(random, grid.request.region);
        const double least = random.one_of(std::vector{0.5, 1e3, costs.cpu_seconds() / 200});
        const Partition partition =
            cut_by_cost(grid.request, costs, {random.between(1, 64), std::max(1e-3, least)});
        expect_sound(partition);
        expect_sound_seams(partition);
        expect_sound_launches(partition, grid.image);
    });
}

TEST(CostProperty, TheLargestImagesAreCutToo) {
    for (const Seams seams : {Seams::aligned, Seams::halo, Seams::plain}) {
        const Rect region{0, 0, 65536, 65536};
        for (const CostMap& costs : {uniform_costs(region, 1e6), hill_costs(region, 1e6)}) {
            EXPECT_NEAR(costs.cpu_seconds(), 1e6, 1e-6);
            const Partition partition =
                cut_by_cost({region, Shape::tiles, seams, 1, 2, 32}, costs, {8, 0.5});
            expect_sound(partition);
            EXPECT_GT(partition.sections.size(), 20U);
        }
    }
    const Rect widest{0, 0, std::numeric_limits<int>::max(), 2};
    EXPECT_NEAR(hill_costs(widest, 7).cpu_seconds(), 7, 1e-9);
    EXPECT_NEAR(stretched(hill_costs({0, 0, 100, 100}, 7), {0, 0, 65536, 65536}).cpu_seconds(),
                7 * 65536.0 * 65536.0 / 1e4, 1);
}

TEST(CostProperty, PartsAddUpAndNoneIsLessThanNothing) {
    constexpr double underflow = 1e-318;  // parts of the smallest double are it, or nothing
    for_rounds(400, [](Random& random) {
        RandomGrid grid = random_grid(random);
        const CostMap costs = wild_costs(random, grid.request.region);
        const double all = costs.cpu_seconds();
        GridRequest cut = grid.request;
        cut.sections = static_cast<int>(std::min<long long>(200, max_sections(cut)));
        double sum = 0;
        for (const Section& section : make_partition(cut).sections) {
            const double part = costs.cpu_seconds(section.keep);
            ASSERT_GE(part, 0);
            ASSERT_LE(part, all * (1 + 1e-12) + underflow);
            sum += part;
        }
        ASSERT_LE(std::abs(sum - all), all * 1e-12 + underflow);
    });
}

TEST(CostProperty, WithAnotherSum) {
    const Rect region{0, 0, 64, 64}, left{0, 0, 32, 64}, right{32, 0, 64, 64};
    for (const double sum : {5e-324, 1e-300, 1.0, 1e300})
        for (const double wanted : {0.0, 1e-3, 1e12}) {
            const CostMap scaled = with_sum({region, {{left, sum}, {right, 0}}}, wanted);
            EXPECT_NEAR(scaled.cpu_seconds(), wanted, wanted * 1e-15);
        }
    EXPECT_THROW(with_sum({region, {{left, 0}}}, 1), std::invalid_argument);
    EXPECT_THROW(with_sum({region, {{left, 1e308}, {right, 1e308}}}, 1), std::invalid_argument);
    for (const double seconds : {nan, infinite, -1.0})
        EXPECT_THROW(CostMap(region, {{left, seconds}}), std::invalid_argument);
}

TEST(CostProperty, TheModelOfAnyTimes) {
    for (const double seconds :
         {0.0, -0.0, 5e-324, 1e-300, 1.0, 1e12, 1e300, -1.0, -1e300, nan, infinite, -infinite})
        for (const int side : {1, 640, 65536}) {
            ProbeResult probe;
            probe.image.width = probe.image.height = side;
            probe.image.region = {0, 0, side, side};
            probe.report.trace_cpu = probe.report.parse_cpu = probe.report.photon_cpu =
                probe.report.radiosity_cpu = seconds;
            probe.report.radiosity = true;
            probe.probe_pixels = side == 1 ? 0 : 768;
            const CostModel cost = make_cost_model(probe);
            for (const double predicted :
                 {cost.render, cost.per_launch, cost.cpu_seconds(1), cost.cpu_seconds(1 << 20),
                  cost.wall_seconds(1, 1, 1), cost.wall_seconds(1 << 20, 1024, 64)}) {
                EXPECT_TRUE(std::isfinite(predicted)) << seconds;
                EXPECT_GE(predicted, 0) << seconds;
            }
            PlanRequest request;
            request.slots = {2, 2};
            probe.stored = {side, side, 3, "png", "uint8"};
            const Plan plan = make_plan(request, probe);
            expect_sound(plan.partition);
            EXPECT_TRUE(std::isfinite(plan.record.predicted.wall_seconds)) << seconds;
        }
}

// The longest a section may take decides, and what it is divided by is beyond a whole number.
TEST(CostProperty, AnAbsurdlyLongRenderIsCutAsFarAsItMay) {
    ProbeResult probe;
    probe.image.width = probe.image.height = 65536;
    probe.image.region = {0, 0, 65536, 65536};
    probe.stored = {65536, 65536, 3, "png", "uint8"};
    // On one core each section only adds to the time: it is cut for no other reason.
    PlanRequest request;
    request.slots = {1};
    probe.report.trace_cpu = 1e-9;
    EXPECT_EQ(make_plan(request, probe).partition.sections.size(), 1U);
    for (const double seconds : {1e9, 1e300}) {
        probe.report.trace_cpu = seconds;
        EXPECT_EQ(make_plan(request, probe).partition.sections.size(), 64U) << seconds;
    }
}

}  // namespace
}  // namespace mpipov
