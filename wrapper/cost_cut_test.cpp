#include "cost_cut.h"

#include "virtual_run.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mpipov {
namespace {

constexpr Rect region{0, 0, 640, 480};

GridRequest grid_of(Seams seams) {
    GridRequest grid;
    grid.region = region;
    grid.seams = seams;
    grid.halo = seams == Seams::halo ? 2 : 0;
    return grid;
}

CostMap corner_costs() {
    const Rect corner{480, 0, 640, 120};
    return {region, {{corner, 30}, {{0, 0, 480, 120}, 0.3}, {{0, 120, 640, 480}, 0.7}}};
}

void expect_covers(const Partition& partition) {
    long long area = 0;
    for (const Section& a : partition.sections) {
        area += a.keep.area();
        for (const Section& b : partition.sections)
            EXPECT_TRUE(a.id == b.id || intersect(a.keep, b.keep).empty());
    }
    EXPECT_EQ(area, region.area());
}

TEST(CutByCost, CoversTheRegionAndKeepsToTheGrid) {
    for (const Seams seams : {Seams::aligned, Seams::halo, Seams::plain})
        for (const int lanes : {1, 2, 7, 64}) {
            const Partition partition = cut_by_cost(grid_of(seams), corner_costs(), {lanes, 0.05});
            expect_covers(partition);
            EXPECT_EQ(partition.request.sections, static_cast<int>(partition.sections.size()));
            for (const Section& section : partition.sections) {
                if (seams != Seams::aligned) continue;
                EXPECT_EQ(section.keep.x0 % 32, 0);
                EXPECT_EQ(section.keep.y0 % 32, 0);
            }
        }
}

TEST(CutByCost, CutsWhereTheCostIs) {
    const CostMap costs = corner_costs();
    const Partition partition = cut_by_cost(grid_of(Seams::aligned), costs, {2, 0.2});
    double most = 0, cheap_area = 0;
    for (const Section& section : partition.sections) {
        most = std::max(most, costs.cpu_seconds(section.keep));
        cheap_area = std::max(cheap_area, static_cast<double>(section.keep.area()));
    }
    EXPECT_LE(most, 31.0 / 2 / 3 + 1e-9);
    EXPECT_GT(cheap_area, region.area() / 4.0) << "what costs nothing is not cut up";
    EXPECT_LT(partition.sections.size(), 24u);
}

TEST(CutByCost, HalvesNothingThatWouldNotPayForItsLaunch) {
    const Partition partition = cut_by_cost(grid_of(Seams::plain), corner_costs(), {64, 16});
    EXPECT_EQ(partition.sections.size(), 1u);
}

// The same schedule on a virtual clock: nearer the ideal than as many sections of the same size.
TEST(CutByCost, EndsEarlierThanARegularGrid) {
    const CostMap costs = corner_costs();
    const auto wall = [&](const Partition& partition) {
        VirtualRun run;
        run.policy = Policy::cost;
        for (const Section& section : partition.sections)
            run.section_cpu.push_back(costs.cpu_seconds(section.keep));
        run.ranks.assign(4, {});
        return run_virtually(run).wall_seconds;
    };
    const Partition by_cost = cut_by_cost(grid_of(Seams::aligned), costs, {4, 0.1});
    GridRequest regular = grid_of(Seams::aligned);
    regular.shape = Shape::tiles;
    regular.sections = static_cast<int>(by_cost.sections.size());
    EXPECT_LT(wall(by_cost), 0.75 * wall(make_partition(regular)));
    EXPECT_LT(wall(by_cost), 1.1 * 31.0 / 4);
}

}  // namespace
}  // namespace mpipov
