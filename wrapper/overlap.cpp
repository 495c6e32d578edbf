#include "overlap.h"

#include <algorithm>
#include <cstring>

namespace mpipov {

Rect copy_pixels(const Rect& from_rect, std::span<const std::byte> from, const Rect& to_rect,
                 std::span<std::byte> to, std::size_t bytes_per_pixel) {
    const Rect part = intersect(from_rect, to_rect);
    if (part.empty()) return part;
    const auto offset = [&](const Rect& r, int y) {
        return (static_cast<std::size_t>(y - r.y0) * static_cast<std::size_t>(r.width()) +
                static_cast<std::size_t>(part.x0 - r.x0)) *
               bytes_per_pixel;
    };
    const std::size_t row = static_cast<std::size_t>(part.width()) * bytes_per_pixel;
    for (int y = part.y0; y < part.y1; ++y)
        std::memcpy(to.data() + offset(to_rect, y), from.data() + offset(from_rect, y), row);
    return part;
}

OverlapCheck::OverlapCheck(const Partition& partition, const PixelLayout& layout)
    : layout_(layout),
      seams_(find_seams(partition.sections)),
      strips_of_section_(partition.sections.size()),
      strips_of_seam_(seams_.size()),
      seams_of_section_(partition.sections.size()),
      finished_(partition.sections.size(), false) {
    const GridRequest& grid = partition.request;
    if (grid.seams == Seams::halo) halo_ = grid.halo;
    for (int i = 0; i < static_cast<int>(seams_.size()); ++i) {
        const Seam& seam = seams_[static_cast<std::size_t>(i)];
        for (const auto& [renderer, owner] :
             {std::pair{seam.a, seam.b}, std::pair{seam.b, seam.a}}) {
            seams_of_section_[static_cast<std::size_t>(renderer)].push_back(i);
            const Section& mine = partition.sections[static_cast<std::size_t>(renderer)];
            const Section& other = partition.sections[static_cast<std::size_t>(owner)];
            const Rect ring = grow(mine.keep, checked_margin(halo_), grid.region);
            const Rect rect = intersect(ring, other.keep);
            if (rect.empty()) continue;
            const auto index = static_cast<int>(strips_.size());
            strips_of_section_[static_cast<std::size_t>(renderer)].push_back(index);
            strips_of_seam_[static_cast<std::size_t>(i)].push_back(index);
            strips_.push_back({rect, std::vector<std::byte>(static_cast<std::size_t>(rect.area()) *
                                                            layout.bytes_per_pixel())});
        }
    }
}

void OverlapCheck::take(int section, const Rect& rect, std::span<const std::byte> pixels) {
    for (const int index : strips_of_section_[static_cast<std::size_t>(section)]) {
        Strip& strip = strips_[static_cast<std::size_t>(index)];
        copy_pixels(rect, pixels, strip.rect, strip.pixels, layout_.bytes_per_pixel());
    }
}

std::vector<int> OverlapCheck::finish(int section) {
    std::vector<int> ready;
    if (finished_[static_cast<std::size_t>(section)]) return ready;
    finished_[static_cast<std::size_t>(section)] = true;
    for (const int index : seams_of_section_[static_cast<std::size_t>(section)]) {
        const Seam& seam = seams_[static_cast<std::size_t>(index)];
        if (finished_[static_cast<std::size_t>(seam.a)] &&
            finished_[static_cast<std::size_t>(seam.b)])
            ready.push_back(index);
    }
    return ready;
}

SeamRecord OverlapCheck::compare(int seam, const Canvas& canvas) const {
    SeamRecord record;
    record.seam = seams_[static_cast<std::size_t>(seam)];
    record.halo = halo_;
    for (const int index : strips_of_seam_[static_cast<std::size_t>(seam)]) {
        const Strip& strip = strips_[static_cast<std::size_t>(index)];
        record.checked = true;
        const Difference difference =
            differing_pixels(canvas, strip.rect, strip.pixels, strip.rect);
        record.differing += difference.pixels;
        record.max_difference = std::max(record.max_difference, difference.largest);
    }
    return record;
}

Section repair_section(int id, const Seam& seam, int halo, const Rect& region) {
    const int half = std::max(1, halo / 2);
    const Rect line = seam.vertical ? Rect{seam.position, seam.from, seam.position, seam.to}
                                    : Rect{seam.from, seam.position, seam.to, seam.position};
    const Rect keep = grow(line, half, region);
    return {id, keep, grow(keep, halo, region)};
}

}  // namespace mpipov
