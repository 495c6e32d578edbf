// The neighbours' self-check of a halo render: two sections that both rendered the same pixels must
// agree on them, in the half of the overlap that is nearer to what each of them keeps. How far an
// edge of what was rendered spoils the pixels is not known beforehand; in the outer half it may,
// and proves nothing, but where it reaches the inner half, the pixels that are kept are next. A
// halo of 1 therefore checks nothing.
#pragma once

#include "image_file.h"
#include "run_record.h"
#include "section.h"
#include "stitch.h"

#include <span>
#include <vector>

namespace mpipov {

// How far beyond what a section keeps its pixels are compared with others' of the same place.
constexpr int checked_margin(int halo) {
    return halo / 2;
}

class OverlapCheck {
  public:
    // `region` bounds what is rendered at all. With other seams than halo there is nothing to
    // check.
    OverlapCheck(const Partition& partition, const PixelLayout& layout);

    const std::vector<Seam>& seams() const { return seams_; }

    // Remembers the parts of a section's band that its neighbours own.
    void take(int section, const Rect& rect, std::span<const std::byte> pixels);

    // Seams, as indices into seams(), whose two sections are both finished now and were not before.
    std::vector<int> finish(int section);

    // Compares what the two sides of a seam rendered for each other with what the canvas holds.
    SeamRecord compare(int seam, const Canvas& canvas) const;

  private:
    struct Strip {
        Rect rect;  // rendered by one section, owned by the one beyond the seam
        std::vector<std::byte> pixels;
    };

    PixelLayout layout_;
    int halo_ = 0;
    std::vector<Seam> seams_;
    std::vector<Strip> strips_;
    // Indices into strips_: those that a section rendered, those of a seam.
    std::vector<std::vector<int>> strips_of_section_, strips_of_seam_;
    std::vector<std::vector<int>> seams_of_section_;
    std::vector<bool> finished_;
};

// The section that renders a seam again with `halo` pixels of overlap: what lies within half of it
// from the seam is kept, and rendered with `halo` more pixels around.
Section repair_section(int id, const Seam& seam, int halo, const Rect& region);

// Copies the part of `from` (rect and pixels) that lies in `to_rect` into `to`; returns that part.
Rect copy_pixels(const Rect& from_rect, std::span<const std::byte> from, const Rect& to_rect,
                 std::span<std::byte> to, std::size_t bytes_per_pixel);

}  // namespace mpipov
