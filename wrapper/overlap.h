// The neighbours' self-check of a halo render: two sections that both rendered the same pixels must
// agree on them. The outermost ring of what a section rendered is left out: there antialiasing
// lacked a neighbour, so it may differ and proves nothing. A halo of 1 therefore checks nothing.
#pragma once

#include "image_file.h"
#include "run_record.h"
#include "section.h"
#include "stitch.h"

#include <span>
#include <vector>

namespace mpipov {

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
        int seam = 0, renderer = 0;  // rendered by `renderer`, owned by the section beyond the seam
        Rect rect;
        std::vector<std::byte> pixels;
    };

    PixelLayout layout_;
    int halo_ = 0;
    std::vector<Seam> seams_;
    std::vector<Strip> strips_;
    std::vector<std::vector<int>> strips_of_section_;  // indices into strips_
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
