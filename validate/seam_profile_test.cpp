#include "seam_profile.h"

#include "test_image.h"

#include <gmock/gmock.h>

#include <limits>

namespace mpipov {
namespace {

SeamReport profile(const TestImage& a, const TestImage& b, const RunRecord& run) {
    SeamProfileBuilder builder(make_seam_layout(run), a.shape());
    for (int y = 0; y < a.height; ++y) builder.add_row(y, a.row(y), b.row(y));
    return builder.finish();
}

long long total_pixels(const SeamReport& report) {
    long long pixels = report.interior.counts.pixels + report.outside.counts.pixels;
    for (const auto& [before, after] : report.by_distance)
        pixels += before.counts.pixels + after.counts.pixels;
    return pixels;
}

TEST(SeamProfile, EveryPixelIsCountedOnce) {
    const TestImage a = textured(200, 150);
    for (const Shape shape : {Shape::columns, Shape::rows, Shape::tiles}) {
        const SeamReport report = profile(a, a, run_of(200, 150, shape, 4));
        EXPECT_EQ(total_pixels(report), 200 * 150);
        long long in_sections = 0;
        for (const SectionErrors& section : report.sections)
            in_sections += section.group.counts.pixels;
        EXPECT_EQ(in_sections, 200 * 150);
        for (const SeamErrors& seam : report.seams) EXPECT_EQ(seam.differing_near, 0);
        EXPECT_EQ(report.seam_steps.mean_step, 0);
    }
}

TEST(SeamProfile, ADifferenceRightAfterASeam) {
    const TestImage a = textured(128, 40);
    TestImage b = a;
    for (int y = 10; y < 25; ++y) b.at(64, y, 1) += 6;
    b.at(64, 30, 1) += 6;
    const SeamReport report = profile(a, b, run_of(128, 40, Shape::columns, 4));
    EXPECT_EQ(report.by_distance[0].after.counts.differing, 16);
    EXPECT_EQ(report.by_distance[0].before.counts.differing, 0);
    EXPECT_EQ(report.by_distance[0].after.errors.max(), 6);
    // Three seams, forty rows, three channels.
    EXPECT_DOUBLE_EQ(*report.by_distance[0].after.errors.mean_abs(), 16 * 6 / 360.0);
    EXPECT_EQ(report.interior.counts.differing, 0);
    ASSERT_EQ(report.seams.size(), 3U);
    EXPECT_EQ(report.seams[0].differing_near, 0);
    EXPECT_EQ(report.seams[1].differing_touching, 16);
    EXPECT_EQ(report.seams[1].longest_run.from, 10);
    EXPECT_EQ(report.seams[1].longest_run.to, 25);
    EXPECT_EQ(report.seams[2].differing_near, 0);
    EXPECT_EQ(report.sections[2].group.counts.differing, 16);
    EXPECT_EQ(report.sections[2].differing_box, (Rect{64, 10, 65, 31}));
    EXPECT_EQ(report.sections[1].group.counts.differing, 0);
    EXPECT_EQ(report.block_edges.after.differing, 16);
    EXPECT_EQ(report.block_edges.before.differing, 0);
}

TEST(SeamProfile, ADifferenceRightAboveARowSeam) {
    const TestImage a = textured(60, 90);
    TestImage b = a;
    for (int x = 20; x < 27; ++x) b.at(x, 29, 0) -= 3;
    const SeamReport report = profile(a, b, run_of(60, 90, Shape::rows, 3));
    EXPECT_EQ(report.by_distance[0].before.counts.differing, 7);
    EXPECT_EQ(report.by_distance[0].after.counts.differing, 0);
    EXPECT_EQ(report.seams[0].differing_touching, 7);
    EXPECT_EQ(report.seams[0].longest_run.from, 20);
    EXPECT_EQ(report.seams[0].longest_run.to, 27);
    EXPECT_EQ(report.seams[1].differing_touching, 0);
    EXPECT_EQ(report.block_edges.after.differing, 0);
}

TEST(SeamProfile, BlockEdgesCountFromTheRegionAndNotItsOwnEdge) {
    const TestImage a = textured(100, 80);
    RunRecord run = run_of(100, 80, Shape::columns, 1);
    run.plan.region = {5, 7, 100, 80};
    run.sections[0].section.keep = run.plan.region;
    TestImage b = a;
    b.at(5, 20, 0) += 1;   // the region's first column: no edge
    b.at(37, 20, 0) += 1;  // 5 + 32
    b.at(36, 21, 0) += 1;  // right before it
    b.at(50, 39, 0) += 1;  // 7 + 32
    b.at(2, 20, 0) += 1;   // not rendered
    b.at(99, 20, 0) += 1;
    const SeamReport report = profile(a, b, run);
    EXPECT_EQ(report.block_edges.after.differing, 2);
    EXPECT_EQ(report.block_edges.before.differing, 1);
    EXPECT_EQ(report.outside.counts.differing, 1);
    EXPECT_EQ(report.outside.counts.pixels, 5 * 80 + 95 * 7);
    EXPECT_EQ(report.interior.counts.differing, 5);
    EXPECT_TRUE(report.seams.empty());
    EXPECT_FALSE(report.seam_steps.mean_step);
}

TEST(SeamStep, OfOneSectionThatIsBrighter) {
    for (const Shape shape : {Shape::columns, Shape::rows}) {
        const TestImage a = textured(96, 96);
        TestImage b = a;
        const RunRecord run = run_of(96, 96, shape, 3);
        const Rect bright = run.sections[1].section.keep;
        for (int y = bright.y0; y < bright.y1; ++y)
            for (int x = bright.x0; x < bright.x1; ++x)
                for (int c = 0; c < 3; ++c) b.at(x, y, c) += c + 1;
        const SeamReport report = profile(a, b, run);
        ASSERT_EQ(report.seams.size(), 2U);
        EXPECT_DOUBLE_EQ(*report.seams[0].step.channels[2], -3);
        EXPECT_DOUBLE_EQ(*report.seams[1].step.channels[2], 3);
        EXPECT_DOUBLE_EQ(*report.seams[0].step.mean_step, 2);
        EXPECT_DOUBLE_EQ(*report.seam_steps.mean_step, 2);
        EXPECT_DOUBLE_EQ(*report.seam_steps.local_step, 2);
        EXPECT_EQ(report.control_steps.lines, 3);
        EXPECT_DOUBLE_EQ(*report.control_steps.mean_step, 0);
    }
}

TEST(SeamStep, ThatChangesSignIsSeenByTheLocalStepOnly) {
    const TestImage a = textured(64, 40, 1);
    TestImage b = a;
    for (int y = 0; y < 40; ++y)
        for (int x = 32; x < 64; ++x) b.at(x, y, 0) += y % 2 == 0 ? 4 : -4;
    const SeamReport report = profile(a, b, run_of(64, 40, Shape::columns, 2));
    EXPECT_DOUBLE_EQ(*report.seam_steps.mean_step, 0);
    EXPECT_DOUBLE_EQ(*report.seam_steps.local_step, 4);
}

TEST(SeamStep, ADifferenceThatIsTheSameEverywhereIsNoSeam) {
    const TestImage a = textured(128, 40);
    TestImage b = a;
    for (double& value : b.values) value += 9;
    const SeamReport report = profile(a, b, run_of(128, 40, Shape::columns, 4));
    EXPECT_DOUBLE_EQ(report.by_distance[9].after.errors.mean_abs().value(), 9);
    EXPECT_FALSE(report.interior.errors.mean_abs());  // sections of 32 columns have no interior
    EXPECT_DOUBLE_EQ(*report.seam_steps.mean_step, 0);
    EXPECT_DOUBLE_EQ(*report.control_steps.local_step, 0);
}

TEST(SeamStep, LeavesOutAlphaAndWhatIsNotFinite) {
    const TestImage a = textured(64, 40, 4);
    TestImage b = a;
    for (int y = 0; y < 40; ++y)
        for (int x = 32; x < 64; ++x) {
            for (int c = 0; c < 3; ++c) b.at(x, y, c) += 2;
            b.at(x, y, 3) += 50;
        }
    b.at(33, 5, 0) = std::numeric_limits<double>::quiet_NaN();
    const SeamReport report = profile(a, b, run_of(64, 40, Shape::columns, 2));
    EXPECT_DOUBLE_EQ(*report.seam_steps.mean_step, 2);
    EXPECT_DOUBLE_EQ(*report.seams[0].step.channels[3], -50);
}

TEST(SeamProfile, RefusesAnImageOfAnotherSize) {
    const SeamLayout layout = make_seam_layout(run_of(64, 40, Shape::columns, 2));
    EXPECT_THROW(SeamProfileBuilder(layout, {64, 41, 3}), std::invalid_argument);
}

}  // namespace
}  // namespace mpipov
