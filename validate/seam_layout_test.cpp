#include "seam_layout.h"

#include "test_image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace mpipov {
namespace {

TEST(SeamDistance, CountsTheSameOnBothSides) {
    const SeamLayout layout = make_seam_layout(run_of(100, 4, Shape::columns, 2));
    ASSERT_EQ(layout.seams.size(), 1U);
    ASSERT_EQ(layout.seams[0].position, 50);
    SeamDistance distance(layout);
    const auto row = distance.row(2);
    EXPECT_EQ(row[50].distance, 0);
    EXPECT_FALSE(row[50].before);
    EXPECT_EQ(row[49].distance, 0);
    EXPECT_TRUE(row[49].before);
    EXPECT_EQ(row[81].distance, 31);
    EXPECT_EQ(row[81].seam, 0);
    EXPECT_EQ(row[82].seam, -1);
    EXPECT_EQ(row[18].distance, 31);
    EXPECT_EQ(row[17].seam, -1);
}

TEST(SeamDistance, OfTilesIsThatOfTheBruteForceSearch) {
    const RunRecord record = run_of(150, 131, Shape::tiles, 6);
    const SeamLayout layout = make_seam_layout(record);
    ASSERT_GE(layout.seams.size(), 5U);
    SeamDistance distance(layout);
    for (int y = 0; y < 131; ++y) {
        const auto row = distance.row(y);
        for (int x = 0; x < 150; ++x) {
            int nearest = 1000;
            for (const Seam& s : layout.seams) {
                const int p = s.vertical ? x : y, q = s.vertical ? y : x;
                const int across = p >= s.position ? p - s.position : s.position - 1 - p;
                const int along = std::max({0, s.from - q, q - s.to + 1});
                nearest = std::min(nearest, std::max(across, along));
            }
            const NearSeam& found = row[static_cast<std::size_t>(x)];
            if (nearest > SeamDistance::reach) {
                ASSERT_EQ(found.seam, -1) << x << ',' << y;
            } else {
                ASSERT_GE(found.seam, 0) << x << ',' << y;
                ASSERT_EQ(found.distance, nearest) << x << ',' << y;
            }
        }
    }
}

TEST(SeamLayout, ControlLinesLieMidwayBetweenSeams) {
    const SeamLayout layout = make_seam_layout(run_of(120, 50, Shape::columns, 3));
    ASSERT_EQ(layout.controls.size(), 3U);
    EXPECT_EQ(layout.controls[1].position, 60);
    EXPECT_TRUE(layout.controls[1].vertical);
    EXPECT_EQ(layout.controls[1].to, 50);
}

TEST(SeamLayout, NoControlLineInANarrowSection) {
    EXPECT_TRUE(make_seam_layout(run_of(30, 50, Shape::columns, 2)).controls.empty());
}

TEST(SeamLayout, RefusesRecordsThatMakeNoSense) {
    RunRecord record = run_of(100, 40, Shape::columns, 4);
    EXPECT_NO_THROW(make_seam_layout(record));
    RunRecord unfinished = record;
    unfinished.complete = false;
    EXPECT_THROW(make_seam_layout(unfinished), std::runtime_error);
    RunRecord gap = record;
    gap.sections.pop_back();
    EXPECT_THROW(make_seam_layout(gap), std::runtime_error);
    RunRecord overlap = record;
    overlap.sections[1].section.keep = overlap.sections[2].section.keep;
    EXPECT_THROW(make_seam_layout(overlap), std::runtime_error);
    RunRecord outside = record;
    outside.plan.image.width = 99;
    EXPECT_THROW(make_seam_layout(outside), std::runtime_error);
    RunRecord twice = record;
    twice.sections[1].section.id = 0;
    EXPECT_THROW(make_seam_layout(twice), std::runtime_error);
}

}  // namespace
}  // namespace mpipov
