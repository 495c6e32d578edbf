#include "section.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace mpipov {
namespace {

GridRequest request(int w, int h, Shape shape, Seams seams, int sections, int halo = 0) {
    return {{0, 0, w, h}, shape, seams, sections, halo, 32};
}

// Every pixel of the region has exactly one owner, no section is empty, and what is rendered holds
// what is kept and stays inside the region.
void expect_sound(const Partition& partition) {
    const Rect region = partition.request.region;
    std::vector<int> owners(static_cast<std::size_t>(region.area()), 0);
    for (const Section& s : partition.sections) {
        ASSERT_FALSE(s.keep.empty());
        ASSERT_EQ(intersect(s.keep, region), s.keep);
        ASSERT_EQ(intersect(s.render, region), s.render);
        ASSERT_EQ(intersect(s.keep, s.render), s.keep);
        for (int y = s.keep.y0; y < s.keep.y1; ++y)
            for (int x = s.keep.x0; x < s.keep.x1; ++x)
                ++owners[static_cast<std::size_t>(y - region.y0) * region.width() + x - region.x0];
    }
    EXPECT_THAT(owners, testing::Each(1));
    EXPECT_EQ(partition.sections.size(), static_cast<std::size_t>(partition.request.sections));
}

TEST(Section, PaperStripsAndTheLastTakesTheRest) {
    const Partition p = make_partition(request(640, 480, Shape::columns, Seams::plain, 7));
    ASSERT_EQ(p.sections.size(), 7u);
    for (int i = 0; i < 6; ++i) EXPECT_EQ(p.sections[i].keep.width(), 91);
    EXPECT_EQ(p.sections[6].keep.width(), 94);
    EXPECT_EQ(p.sections[6].keep.x1, 640);
}

TEST(Section, ALargeRestIsSpread) {
    const Partition p = make_partition(request(100, 10, Shape::columns, Seams::plain, 60));
    for (const Section& s : p.sections) EXPECT_LE(s.keep.width(), 2);
}

TEST(Section, AlignedEdgesLieOnTheBlockGridOfTheRegion) {
    GridRequest r = request(200, 150, Shape::tiles, Seams::aligned, 9);
    r.region = {7, 11, 190, 140};
    for (const Section& s : make_partition(r).sections) {
        EXPECT_EQ((s.keep.x0 - 7) % 32, 0);
        EXPECT_EQ((s.keep.y0 - 11) % 32, 0);
        EXPECT_TRUE(s.keep.x1 == 190 || (s.keep.x1 - 7) % 32 == 0);
        EXPECT_TRUE(s.keep.y1 == 140 || (s.keep.y1 - 11) % 32 == 0);
    }
}

TEST(Section, AlignedHoldsAsManySectionsAsTheGridHasCells) {
    EXPECT_EQ(max_sections(request(800, 600, Shape::columns, Seams::aligned, 1)), 25);
    EXPECT_EQ(max_sections(request(800, 600, Shape::rows, Seams::aligned, 1)), 19);
    EXPECT_EQ(max_sections(request(800, 600, Shape::tiles, Seams::aligned, 1)), 25 * 19);
    EXPECT_THROW(make_partition(request(800, 600, Shape::columns, Seams::aligned, 26)),
                 std::invalid_argument);
    EXPECT_THROW(make_partition(request(800, 600, Shape::columns, Seams::aligned, 0)),
                 std::invalid_argument);
}

TEST(Section, HaloGrowsInsideOnly) {
    const Partition p = make_partition(request(100, 50, Shape::columns, Seams::halo, 4, 2));
    EXPECT_EQ(p.sections[0].render, (Rect{0, 0, 27, 50}));
    EXPECT_EQ(p.sections[1].render, (Rect{23, 0, 52, 50}));
    EXPECT_EQ(p.sections[3].render, (Rect{73, 0, 100, 50}));
}

TEST(Section, EmptyRegionIsRefused) {
    GridRequest r = request(10, 10, Shape::columns, Seams::plain, 1);
    r.region = {5, 5, 5, 9};
    EXPECT_THROW(make_partition(r), std::invalid_argument);
}

TEST(Section, ExtremesAreSound) {
    for (const Shape shape : {Shape::columns, Shape::rows, Shape::tiles})
        for (const Seams seams : {Seams::aligned, Seams::halo, Seams::plain})
            for (const auto& [w, h] : {std::pair{1, 1}, {97, 1}, {1, 97}, {31, 33}, {101, 103}}) {
                GridRequest r = request(w, h, shape, seams, 1, 2);
                expect_sound(make_partition(r));
                r.sections = static_cast<int>(max_sections(r));
                expect_sound(make_partition(r));
            }
}

TEST(Section, ManyRandomPartitionsAreSound) {
    std::mt19937 random(1999);
    const auto draw = [&](int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(random);
    };
    for (int trial = 0; trial < 2000; ++trial) {
        GridRequest r;
        r.region.x0 = draw(0, 50);
        r.region.y0 = draw(0, 50);
        r.region.x1 = r.region.x0 + draw(1, 120);
        r.region.y1 = r.region.y0 + draw(1, 120);
        r.shape = static_cast<Shape>(draw(0, 2));
        r.seams = static_cast<Seams>(draw(0, 2));
        r.block = draw(1, 40);
        r.halo = draw(0, 5);
        r.sections = draw(1, static_cast<int>(max_sections(r)));
        SCOPED_TRACE(testing::Message() << "trial " << trial);
        expect_sound(make_partition(r));
    }
}

TEST(Section, SeamsOfColumns) {
    const auto seams =
        find_seams(make_partition(request(90, 40, Shape::columns, Seams::plain, 3)).sections);
    ASSERT_EQ(seams.size(), 2u);
    EXPECT_EQ(seams[0], (Seam{0, 1, true, 30, 0, 40}));
    EXPECT_EQ(seams[1], (Seam{1, 2, true, 60, 0, 40}));
}

TEST(Section, SeamsOfUnequalTileRowsShareTheirEdge) {
    const Partition p = make_partition(request(120, 120, Shape::tiles, Seams::plain, 5));
    long long vertical = 0, horizontal = 0;
    for (const Seam& s : find_seams(p.sections))
        (s.vertical ? vertical : horizontal) += s.to - s.from;
    EXPECT_EQ(horizontal, 120);  // one line between the two rows, in pieces
    EXPECT_GT(vertical, 120);    // two inner edges in the row of three, one in the row of two
}

}  // namespace
}  // namespace mpipov
