#include "radiosity_sharing.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace mpipov {
namespace {

Partition grid(Shape shape, int sections, const Rect& region = {0, 0, 320, 224}) {
    return make_partition({region, shape, Seams::aligned, sections, 0, 32});
}

TEST(RadiositySharing, IndependentSectionsGatherNothing) {
    EXPECT_TRUE(gather_waves({}, {320, 224}, grid(Shape::columns, 4)).empty());
}

TEST(RadiositySharing, SharedIsOneLaunchOfTheRegionInEachPass) {
    const Rect region{32, 64, 320, 224};
    const auto waves =
        gather_waves({Sharing::shared, 3, 1}, {320, 224}, grid(Shape::columns, 4, region));
    ASSERT_EQ(waves.size(), 3U);
    for (const GatherWave& wave : waves) {
        EXPECT_EQ(wave.image.width, 320);
        ASSERT_EQ(wave.sections.size(), 1U);
        EXPECT_EQ(wave.sections[0], (Section{0, region, region}));
    }
}

TEST(RadiositySharing, ColumnsAreGatheredEverySecondOne) {
    const Partition partition = grid(Shape::columns, 5);
    const auto waves = gather_waves({Sharing::joined, 1, 1}, {320, 224}, partition);
    ASSERT_EQ(waves.size(), 2U);
    ASSERT_EQ(waves[0].sections.size(), 3U);
    ASSERT_EQ(waves[1].sections.size(), 2U);
    EXPECT_EQ(waves[0].sections[1].render, partition.sections[2].keep);
    EXPECT_EQ(waves[1].sections[1].render, partition.sections[3].keep);
    EXPECT_EQ(waves[1].sections[1].id, 1);
}

TEST(RadiositySharing, TilesAreAChessboard) {
    const auto waves = gather_waves({Sharing::joined, 1, 1}, {320, 224}, grid(Shape::tiles, 12));
    ASSERT_EQ(waves.size(), 2U);
    EXPECT_EQ(waves[0].sections.size(), 6U);
    EXPECT_EQ(waves[1].sections.size(), 6U);
}

TEST(RadiositySharing, OneSectionIsOneWave) {
    EXPECT_EQ(gather_waves({Sharing::joined, 1, 1}, {320, 224}, grid(Shape::columns, 1)).size(),
              1U);
}

TEST(RadiositySharing, PassesGoFromCoarseToFineAndOnlyTheLastSparesNeighbours) {
    const auto waves = gather_waves({Sharing::joined, 3, 2}, {320, 224}, grid(Shape::columns, 5));
    ASSERT_EQ(waves.size(), 4U);
    const std::vector<int> widths{40, 80, 160, 160};
    const std::vector<std::size_t> sections{5, 5, 3, 2};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(waves[i].image.width, widths[i]);
        EXPECT_EQ(waves[i].sections.size(), sections[i]);
    }
}

TEST(RadiositySharing, ManyPassesEndAtAFewPixels) {
    const auto waves = gather_waves({Sharing::joined, 100, 1}, {320, 224}, grid(Shape::columns, 5));
    EXPECT_EQ(waves.size(), 101U);
    EXPECT_EQ(waves[0].image.width, 2);
    EXPECT_EQ(waves[0].image.height, 2);
}

TEST(RadiositySharing, HalosAreNotGathered) {
    const Partition partition =
        make_partition({{0, 0, 320, 224}, Shape::columns, Seams::halo, 4, 2, 32});
    for (const GatherWave& wave : gather_waves({Sharing::joined, 1, 1}, {320, 224}, partition))
        for (const Section& section : wave.sections) EXPECT_EQ(section.render, section.keep);
}

TEST(RadiositySharing, EveryPixelIsGatheredOnceInAPassAndNeighboursInDifferentWaves) {
    std::mt19937 random(5);
    for (int round = 0; round < 200; ++round) {
        const Rect region{static_cast<int>(random() % 50), static_cast<int>(random() % 50),
                          100 + static_cast<int>(random() % 400),
                          100 + static_cast<int>(random() % 300)};
        GridRequest request{region, static_cast<Shape>(random() % 3), Seams::plain, 1, 0, 32};
        request.sections = 1 + static_cast<int>(random() % 50);
        const Partition partition = make_partition(request);
        long long pixels = 0;
        std::size_t sections = 0;
        for (const GatherWave& wave :
             gather_waves({Sharing::joined, 1, 1}, {500, 400}, partition)) {
            sections += wave.sections.size();
            for (const Section& section : wave.sections) pixels += section.keep.area();
            EXPECT_TRUE(find_seams(wave.sections).empty());
        }
        EXPECT_EQ(pixels, region.area());
        EXPECT_EQ(sections, partition.sections.size());
    }
}

TEST(RadiositySharing, SmallPassesCoverTheSmallRegionAndStayInside) {
    const Partition partition = grid(Shape::tiles, 60, {0, 0, 300, 200});
    for (const int scale : {2, 3, 16, 64, 1000}) {
        const auto waves = gather_waves({Sharing::joined, 1, scale}, {300, 200}, partition);
        std::set<std::pair<int, int>> covered;
        for (const GatherWave& wave : waves) {
            EXPECT_GE(wave.image.width, 2);
            EXPECT_GE(wave.image.height, 2);
            for (const Section& section : wave.sections) {
                const Rect& r = section.render;
                EXPECT_FALSE(r.empty());
                EXPECT_EQ(intersect(r, {0, 0, wave.image.width, wave.image.height}), r);
                for (int y = r.y0; y < r.y1; ++y)
                    for (int x = r.x0; x < r.x1; ++x) covered.emplace(x, y);
            }
        }
        EXPECT_EQ(covered.size(), static_cast<std::size_t>(waves[0].image.width) *
                                      static_cast<std::size_t>(waves[0].image.height))
            << scale;
    }
}

TEST(RadiositySharing, IsDescribed) {
    EXPECT_EQ(describe({}), "independent");
    EXPECT_EQ(describe({Sharing::shared, 2, 1}), "shared:2");
    EXPECT_EQ(describe({Sharing::joined, 1, 2}), "joined:1 at 1/2");
}

}  // namespace
}  // namespace mpipov
