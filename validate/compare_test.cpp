// Known damage to a known place: the comparison has to name that place and nothing else.
#include "compare.h"

#include "failure.h"
#include "scratch.h"
#include "test_image.h"

#include <gmock/gmock.h>

#include <cmath>
#include <csignal>
#include <limits>

namespace mpipov {
namespace {

using OIIO::TypeDesc;
constexpr int width = 128, height = 96;

// Sections of 32 columns; seams at 32, 64 and 96.
class Mutation : public testing::Test {
  protected:
    Comparison compare(const TypeDesc& type = TypeDesc::UINT8, int rows_per_band = 64) {
        const bool exr = type.is_floating_point();
        const auto file = [&](const char* name) {
            return folder_.path() / (std::string(name) + (exr ? ".exr" : ".png"));
        };
        write_image(file("a"), a_, type);
        write_image(file("b"), b_, type);
        return compare_images(
            {file("a"), file("b"), run_of(width, height, Shape::columns, 4), 1, rows_per_band});
    }

    // Every differing pixel and the largest error lie in `place`, and the box touches its corners.
    static void expect_only_in(const Comparison& found, const Rect& place) {
        EXPECT_FALSE(found.identical());
        EXPECT_EQ(found.metrics.differing_box, place);
        ASSERT_TRUE(found.metrics.largest);
        EXPECT_TRUE(place.contains(found.metrics.largest->x, found.metrics.largest->y));
        ASSERT_TRUE(found.seams);
        for (const SectionErrors& section : found.seams->sections) {
            const bool touched = !intersect(section.section.keep, place).empty();
            EXPECT_EQ(section.group.counts.differing > 0, touched) << section.section.id;
            if (touched) {
                EXPECT_EQ(section.differing_box, intersect(section.section.keep, place));
            }
        }
    }

    static std::vector<int> touched_seams(const Comparison& found) {
        std::vector<int> positions;
        for (const SeamErrors& seam : found.seams->seams)
            if (seam.differing_touching > 0) positions.push_back(seam.seam.position);
        return positions;
    }

    ScratchFolder folder_{"test"};
    TestImage a_ = textured(width, height), b_ = a_;
};

TEST_F(Mutation, NoneIsIdentical) {
    const Comparison found = compare();
    EXPECT_TRUE(found.identical());
    EXPECT_FALSE(found.psnr());
    EXPECT_EQ(found.seams->interior.counts.differing, 0);
}

TEST_F(Mutation, OneLevelAddedToARectangle) {
    const Rect place{70, 20, 80, 30};
    for (int y = place.y0; y < place.y1; ++y)
        for (int x = place.x0; x < place.x1; ++x) b_.at(x, y, 2) += 1;
    const Comparison found = compare();
    expect_only_in(found, place);
    EXPECT_EQ(found.metrics.counts.differing, 100);
    EXPECT_EQ(found.metrics.all.max(), 1);
    EXPECT_EQ(found.metrics.channels[0].max(), 0);
    EXPECT_DOUBLE_EQ(*found.metrics.all.mean_abs(), 100.0 / (width * height * 3));
    EXPECT_TRUE(touched_seams(found).empty());
    EXPECT_EQ(found.seams->by_distance[6].after.counts.differing, 10);  // x = 70, seam at 64
    EXPECT_EQ(found.seams->by_distance[5].after.counts.differing, 0);
}

TEST_F(Mutation, TwoRectanglesSwapped) {
    for (int y = 40; y < 50; ++y)
        for (int x = 5; x < 15; ++x)
            for (int c = 0; c < 3; ++c) std::swap(b_.at(x, y, c), b_.at(x + 100, y, c));
    const Comparison found = compare();
    EXPECT_EQ(found.metrics.differing_box, (Rect{5, 40, 115, 50}));
    const auto& sections = found.seams->sections;
    EXPECT_EQ(sections[0].differing_box, (Rect{5, 40, 15, 50}));
    EXPECT_EQ(sections[1].group.counts.differing, 0);
    EXPECT_EQ(sections[2].group.counts.differing, 0);
    EXPECT_EQ(sections[3].differing_box, (Rect{105, 40, 115, 50}));
    EXPECT_NEAR(*found.metrics.all.mean_signed(), 0, 1e-12);
}

TEST_F(Mutation, ASectionShiftedByOnePixel) {
    for (int y = 0; y < height; ++y)
        for (int x = 32; x < 64; ++x)
            for (int c = 0; c < 3; ++c) b_.at(x, y, c) = a_.at(x + 1, y, c);
    const Comparison found = compare();
    expect_only_in(found, {32, 0, 64, height});
    EXPECT_THAT(touched_seams(found), testing::ElementsAre(32, 64));
}

TEST_F(Mutation, TheLastColumnIsMissing) {
    for (int y = 0; y < height; ++y)
        for (int c = 0; c < 3; ++c) b_.at(width - 1, y, c) = 0;
    const Comparison found = compare();
    expect_only_in(found, {width - 1, 0, width, height});
    EXPECT_EQ(found.metrics.largest->b, 0);
    EXPECT_EQ(found.metrics.counts.differing, height);
}

TEST_F(Mutation, OneNaN) {
    b_.at(50, 60, 1) = std::numeric_limits<double>::quiet_NaN();
    for (const TypeDesc& type : {TypeDesc(TypeDesc::FLOAT), TypeDesc(TypeDesc::HALF)}) {
        const Comparison found = compare(type);
        EXPECT_FALSE(found.identical());
        EXPECT_EQ(found.metrics.differing_box, (Rect{50, 60, 51, 61}));
        ASSERT_EQ(found.metrics.nonfinite.first.size(), 1U);
        EXPECT_EQ(found.metrics.nonfinite.first[0].x, 50);
        EXPECT_EQ(found.metrics.nonfinite.first[0].y, 60);
        EXPECT_EQ(found.metrics.all.rms(), 0);
        EXPECT_EQ(found.seams->sections[1].group.counts.differing, 1);
    }
}

TEST_F(Mutation, AnotherGammaInARectangle) {
    const Rect place{98, 3, 120, 17};
    for (int y = place.y0; y < place.y1; ++y)
        for (int x = place.x0; x < place.x1; ++x)
            for (int c = 0; c < 3; ++c)
                b_.at(x, y, c) = std::round(255 * std::pow(a_.at(x, y, c) / 255, 1 / 2.2));
    const Comparison found = compare();
    expect_only_in(found, place);
    EXPECT_GT(*found.metrics.all.mean_signed(), 0);
    EXPECT_TRUE(touched_seams(found).empty());
}

TEST_F(Mutation, ABlurredSeam) {
    for (int y = 0; y < height; ++y)
        for (int x = 63; x < 65; ++x)
            for (int c = 0; c < 3; ++c)
                b_.at(x, y, c) =
                    std::floor((a_.at(x - 1, y, c) + 2 * a_.at(x, y, c) + a_.at(x + 1, y, c)) / 4);
    const Comparison found = compare();
    expect_only_in(found, {63, 0, 65, height});
    EXPECT_THAT(touched_seams(found), testing::ElementsAre(64));
    const SeamErrors& seam = found.seams->seams[1];
    EXPECT_EQ(seam.longest_run.from, 0);
    EXPECT_EQ(seam.longest_run.to, height);
    EXPECT_EQ(seam.differing_near, seam.differing_touching);
}

TEST_F(Mutation, TheSizeOfBandsChangesNothing) {
    for (int i = 0; i < 900; ++i) b_.at(i * 7 % width, i * 13 % height, i % 3) += i % 9;
    const Comparison whole = compare(TypeDesc::FLOAT, height);
    for (const int rows : {1, 5, 32, 95}) {
        const Comparison bands = compare(TypeDesc::FLOAT, rows);
        EXPECT_EQ(bands.metrics.all.rms(), whole.metrics.all.rms()) << rows;
        EXPECT_EQ(bands.metrics.all.mean_signed(), whole.metrics.all.mean_signed()) << rows;
        EXPECT_EQ(bands.seams->seam_steps.mean_step, whole.seams->seam_steps.mean_step) << rows;
    }
}

TEST_F(Mutation, ErrorsOf16BitsAreInTheirOwnLevels) {
    b_.at(3, 4, 0) += 2;
    const Comparison found = compare(TypeDesc::UINT16);
    EXPECT_EQ(found.metrics.all.max(), 2);
    EXPECT_EQ(found.format.full_scale(), 65535);
    EXPECT_NEAR(*found.psnr(), 20 * std::log10(65535 / std::sqrt(4.0 / (width * height * 3))),
                1e-9);
}

TEST_F(Mutation, PeakShiftsPsnrOfFloats) {
    b_.at(3, 4, 0) += 2;
    Comparison found = compare(TypeDesc::FLOAT);
    const double psnr = *found.psnr();
    found.peak = 10;
    EXPECT_NEAR(*found.psnr(), psnr + 20, 1e-9);
}

std::string failure_of(const CompareRequest& request) {
    try {
        compare_images(request);
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), Exit::file);
        return failure.what();
    }
    return "no failure";
}

TEST(CompareImages, StopsWhenInterrupted) {
    const ScratchFolder folder("test");
    const auto file = folder.path() / "a.png";
    write_image(file, textured(20, 10), TypeDesc::UINT8);
    sigset_t before, term;
    sigemptyset(&term);
    sigaddset(&term, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &term, &before);
    std::raise(SIGTERM);
    Exit code = Exit::ok;
    try {
        compare_images({file, file, {}});
    } catch (const Failure& failure) {
        code = failure.code();
    }
    const timespec now{};
    sigtimedwait(&term, nullptr, &now);
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    EXPECT_EQ(code, Exit::interrupted);
}

TEST(CompareImages, WhatCannotBeComparedIsAnErrorAndNoScore) {
    const ScratchFolder folder("test");
    const auto file = [&](const char* name) { return folder.path() / name; };
    write_image(file("a.png"), textured(20, 10), TypeDesc::UINT8);
    write_image(file("wide.png"), textured(21, 10), TypeDesc::UINT8);
    write_image(file("alpha.png"), textured(20, 10, 4), TypeDesc::UINT8);
    write_image(file("deep.png"), textured(20, 10), TypeDesc::UINT16);
    using testing::HasSubstr;
    EXPECT_THAT(failure_of({file("a.png"), file("wide.png"), {}}),
                HasSubstr("their sizes differ, 20 x 10 and 21 x 10"));
    EXPECT_THAT(failure_of({file("a.png"), file("alpha.png"), {}}),
                HasSubstr("their channels differ, R,G,B and R,G,B,A"));
    EXPECT_THAT(failure_of({file("a.png"), file("deep.png"), {}}),
                HasSubstr("their depths differ, uint8 and uint16"));
    EXPECT_THAT(failure_of({file("a.png"), file("none.png"), {}}), HasSubstr("none.png"));
    EXPECT_THAT(failure_of({file("a.png"), file("a.png"), run_of(64, 10, Shape::columns, 2)}),
                HasSubstr("the run rendered 64 x 10 pixels, not 20 x 10"));
}

}  // namespace
}  // namespace mpipov
