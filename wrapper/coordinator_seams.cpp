// The coordinator's care for seams: overlaps that disagree are rendered again, wider.
#include "coordinator.h"

#include <algorithm>
#include <utility>

namespace mpipov {

// What it rendered around the seam is compared with what its two sections have there.
void Coordinator::take_repair_band(Progress& progress, const Rect& rect,
                                   std::span<const std::byte> pixels) {
    const Rect& keep = progress.record.section.keep;
    const Seam& seam = overlap_.seams()[static_cast<std::size_t>(progress.seam)];
    SeamRecord& found = progress.disagreement;
    const Rect ring = grow(keep, checked_margin(found.halo), setup_.partition.request.region);
    for (const int side : {seam.a, seam.b}) {
        const Rect around =
            intersect(ring, setup_.partition.sections[static_cast<std::size_t>(side)].keep);
        for (const Rect& part : {Rect{around.x0, keep.y0, keep.x0, keep.y1},
                                 Rect{keep.x1, keep.y0, around.x1, keep.y1},
                                 Rect{around.x0, around.y0, around.x1, keep.y0},
                                 Rect{around.x0, keep.y1, around.x1, around.y1}}) {
            const Difference difference =
                differing_pixels(canvas_, rect, pixels, intersect(part, around));
            found.differing += difference.pixels;
            found.max_difference = std::max(found.max_difference, difference.largest);
        }
    }
    const std::size_t pixel = canvas_.layout().bytes_per_pixel();
    progress.repaired.resize(static_cast<std::size_t>(keep.area()) * pixel);
    copy_pixels(rect, pixels, keep, progress.repaired, pixel);
}

void Coordinator::check_seam(int seam) {
    SeamRecord& record = seams_[static_cast<std::size_t>(seam)];
    record = overlap_.compare(seam, canvas_);
    if (record.differing > 0) repair(seam, record.halo);
}

// With twice the halo that was not enough.
void Coordinator::repair(int seam, int too_small) {
    if (too_small > setup_.widest_halo / 2) return;
    const int halo = 2 * too_small;
    Progress again;
    again.seam = seam;
    again.record.section = repair_section(static_cast<int>(sections_.size()),
                                          overlap_.seams()[static_cast<std::size_t>(seam)], halo,
                                          setup_.partition.request.region);
    again.disagreement.halo = halo;
    pixels_ += static_cast<double>(again.record.section.keep.area());
    schedule_.add(again.record.section.id);
    sections_.push_back(std::move(again));
}

void Coordinator::check_repair(Progress& done) {
    // `done` dangles as soon as repair() adds a section.
    const SeamRecord found = done.disagreement;
    const int seam = done.seam;
    SeamRecord& record = seams_[static_cast<std::size_t>(seam)];
    record.halo = found.halo;
    if (found.differing > 0) repair(seam, found.halo);
}

void Coordinator::place_repairs() {
    std::vector<const Progress*> repairs;
    for (const Progress& progress : sections_)
        if (progress.seam >= 0) repairs.push_back(&progress);
    std::sort(repairs.begin(), repairs.end(), [](const Progress* a, const Progress* b) {
        return std::pair(a->seam, a->disagreement.halo) < std::pair(b->seam, b->disagreement.halo);
    });
    for (const Progress* repair : repairs) {
        const Rect& keep = repair->record.section.keep;
        canvas_.place(keep, repair->repaired, keep);
    }
}

}  // namespace mpipov
