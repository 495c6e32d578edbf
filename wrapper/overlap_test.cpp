#include "overlap.h"

#include "known_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace mpipov {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr Rect image{0, 0, 40, 20};
constexpr PixelLayout layout{40, 20, known_channels, Depth::uint8};

Partition halves(int halo, Shape shape = Shape::columns) {
    return make_partition({image, shape, halo > 0 ? Seams::halo : Seams::plain, 2, halo, 32});
}

std::vector<std::byte> known_but(const Rect& rect, int x, int y, int step) {
    std::vector<std::byte> pixels = known_pixels(rect);
    const auto at =
        (static_cast<std::size_t>(y - rect.y0) * static_cast<std::size_t>(rect.width()) +
         static_cast<std::size_t>(x - rect.x0)) *
        known_channels;
    pixels.at(at) = static_cast<std::byte>(std::to_integer<int>(pixels.at(at)) + step);
    return pixels;
}

class Halves {
  public:
    explicit Halves(int halo, Shape shape = Shape::columns)
        : partition_(halves(halo, shape)), check_(partition_, layout), canvas_(layout) {}

    void take(int section, const std::vector<std::byte>& pixels) {
        const Section& s = partition_.sections[static_cast<std::size_t>(section)];
        canvas_.place(s.render, pixels, s.keep);
        check_.take(section, s.render, pixels);
    }
    void take_known(int section) { take(section, known_pixels(render(section))); }
    const Rect& render(int section) const {
        return partition_.sections[static_cast<std::size_t>(section)].render;
    }
    std::vector<int> finish(int section) { return check_.finish(section); }
    SeamRecord compare() const { return check_.compare(0, canvas_); }

  private:
    Partition partition_;
    OverlapCheck check_;
    Canvas canvas_;
};

TEST(OverlapCheck, ASeamIsReadyOnceBothSidesAreFinished) {
    Halves h(2);
    EXPECT_THAT(h.finish(1), IsEmpty());
    EXPECT_THAT(h.finish(1), IsEmpty()) << "twice the same is not both";
    EXPECT_THAT(h.finish(0), ElementsAre(0));
    EXPECT_THAT(h.finish(0), IsEmpty()) << "ready only once";
}

TEST(OverlapCheck, EqualOverlapsAgree) {
    for (const Shape shape : {Shape::columns, Shape::rows})
        for (const int halo : {2, 3, 4, 8}) {
            Halves h(halo, shape);
            h.take_known(0);
            h.take_known(1);
            const SeamRecord record = h.compare();
            EXPECT_TRUE(record.checked);
            EXPECT_EQ(record.differing, 0);
            EXPECT_EQ(record.halo, halo);
            EXPECT_EQ(record.seam.vertical, shape == Shape::columns);
        }
}

TEST(OverlapCheck, WithoutAWideEnoughHaloNothingIsChecked) {
    for (const int halo : {0, 1}) {
        Halves h(halo);
        h.take_known(0);
        h.take(1, known_but(h.render(1), 20, 3, 9));
        EXPECT_FALSE(h.compare().checked);
        EXPECT_EQ(h.compare().differing, 0);
    }
}

// With a halo of 4, columns 18 to 21 are compared: each side's two that are next to the seam.
TEST(OverlapCheck, TheInnerHalfOfTheOverlapIsCompared) {
    for (int x = 16; x < 24; ++x) {
        Halves left(4), right(4);
        left.take(0, known_but(left.render(0), x, 7, 9));
        left.take_known(1);
        right.take_known(0);
        right.take(1, known_but(right.render(1), x, 7, 9));
        const bool seen = x >= 18 && x < 22;
        EXPECT_EQ(left.compare().differing, seen ? 1 : 0) << x;
        EXPECT_EQ(right.compare().differing, seen ? 1 : 0) << x;
        EXPECT_EQ(left.compare().max_difference, seen ? 9 : 0) << x;
    }
}

TEST(OverlapCheck, BandsAddUpAndANewAttemptReplacesTheFirst) {
    Halves bands(2);
    bands.take(0, known_but(bands.render(0), 20, 19, 30));
    bands.take_known(1);
    EXPECT_EQ(bands.compare().differing, 1);
    bands.take_known(0);
    EXPECT_EQ(bands.compare().differing, 0);

    const Partition partition = halves(2);
    OverlapCheck check(partition, layout);
    Canvas canvas(layout);
    canvas.place(image, known_pixels(image), image);
    for (const Section& s : partition.sections)
        for (int y = 0; y < 20; y += 5) {
            const Rect band{s.render.x0, y, s.render.x1, y + 5};
            check.take(s.id, band, known_pixels(band));
        }
    EXPECT_EQ(check.compare(0, canvas).differing, 0);
}

TEST(OverlapCheck, FindsEverySeamOfTiles) {
    const Partition tiles = make_partition({image, Shape::tiles, Seams::halo, 6, 2, 32});
    OverlapCheck check(tiles, layout);
    EXPECT_EQ(check.seams(), find_seams(tiles.sections));
    std::vector<int> ready;
    for (const Section& s : tiles.sections) {
        check.take(s.id, s.render, known_pixels(s.render));
        const std::vector<int> now = check.finish(s.id);
        ready.insert(ready.end(), now.begin(), now.end());
    }
    std::sort(ready.begin(), ready.end());
    std::vector<int> all(check.seams().size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    EXPECT_EQ(ready, all);
    Canvas empty(layout);
    for (const int seam : all) EXPECT_GT(check.compare(seam, empty).differing, 0);
}

TEST(RepairSection, KeepsHalfItsHaloOnEachSideAndStaysInTheRegion) {
    const Seam vertical{0, 1, true, 20, 5, 15};
    const Section s = repair_section(7, vertical, 4, image);
    EXPECT_EQ(s.id, 7);
    EXPECT_EQ(s.keep, (Rect{18, 3, 22, 17}));
    EXPECT_EQ(s.render, (Rect{14, 0, 26, 20}));
    const Seam horizontal{0, 1, false, 10, 0, 40};
    EXPECT_EQ(repair_section(0, horizontal, 8, image).keep, (Rect{0, 6, 40, 14}));
    EXPECT_EQ(repair_section(0, horizontal, 8, image).render, (Rect{0, 0, 40, 20}));
}

TEST(CopyPixels, CopiesOnlyWhatBothHold) {
    const Rect from{2, 2, 6, 6}, to{4, 0, 9, 5};
    std::vector<std::byte> target(static_cast<std::size_t>(to.area()) * known_channels);
    EXPECT_EQ(copy_pixels(from, known_pixels(from), to, target, known_channels),
              (Rect{4, 2, 6, 5}));
    const std::vector<std::byte> known = known_pixels(to);
    std::size_t at = 0;
    for (int y = to.y0; y < to.y1; ++y)
        for (int x = to.x0; x < to.x1; ++x)
            for (int c = 0; c < known_channels; ++c, ++at)
                EXPECT_EQ(target[at], from.contains(x, y) ? known[at] : std::byte{0});
    EXPECT_TRUE(copy_pixels(from, known_pixels(from), {9, 9, 12, 12}, target, 3).empty());
}

}  // namespace
}  // namespace mpipov
