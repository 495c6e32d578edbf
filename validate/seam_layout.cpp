#include "seam_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace mpipov {
namespace {

// A control line's windows of 8 pixels must stay inside its section.
constexpr int narrowest_with_control = 16;

void check_tiling(const SeamLayout& layout) {
    const auto fail = [](const std::string& why) {
        throw std::runtime_error("the run record makes no sense: " + why);
    };
    const Rect& region = layout.region;
    if (region.empty() || intersect(region, {0, 0, layout.width, layout.height}) != region)
        fail("the rendered region is not inside the image");
    long long area = 0;
    for (std::size_t i = 0; i < layout.sections.size(); ++i) {
        const Section& section = layout.sections[i];
        if (section.keep.empty() || intersect(section.keep, region) != section.keep)
            fail(fmt::format("section {} is not inside the rendered region", section.id));
        if (i > 0 && layout.sections[i - 1].id == section.id)
            fail(fmt::format("there are two sections {}", section.id));
        area += section.keep.area();
    }
    // Overlaps matter only where the area is right: look for them by rows of sections sharing y.
    if (area != region.area()) fail("its sections do not tile the rendered region");
    std::vector<const Section*> by_top;
    for (const Section& section : layout.sections) by_top.push_back(&section);
    std::sort(by_top.begin(), by_top.end(),
              [](const Section* p, const Section* q) { return p->keep.y0 < q->keep.y0; });
    for (std::size_t i = 0; i < by_top.size(); ++i)
        for (std::size_t j = i + 1; j < by_top.size(); ++j) {
            if (by_top[j]->keep.y0 >= by_top[i]->keep.y1) break;
            if (!intersect(by_top[i]->keep, by_top[j]->keep).empty())
                fail(fmt::format("sections {} and {} overlap", by_top[i]->id, by_top[j]->id));
        }
}

std::vector<Seam> control_lines(const std::vector<Section>& sections,
                                const std::vector<Seam>& seams) {
    std::vector<Seam> controls;
    for (const bool vertical : {true, false}) {
        const auto same_way = [&](const Seam& seam) { return seam.vertical == vertical; };
        if (std::none_of(seams.begin(), seams.end(), same_way)) continue;
        for (const auto& [id, keep, render] : sections) {
            if ((vertical ? keep.width() : keep.height()) < narrowest_with_control) continue;
            const int middle = vertical ? keep.x0 + keep.width() / 2 : keep.y0 + keep.height() / 2;
            controls.push_back({id, id, vertical, middle, vertical ? keep.y0 : keep.x0,
                                vertical ? keep.y1 : keep.x1});
        }
    }
    return controls;
}

// How far p is outside the half-open [from, to); 0 inside.
int outside(int p, int from, int to) {
    return std::max({0, from - p, p - (to - 1)});
}

// Of a line at `position`: 0 for the pixel on either side of it.
int across(int p, int position) {
    return p >= position ? p - position : position - 1 - p;
}

}  // namespace

const Section& SeamLayout::section(int id) const {
    const auto found = std::lower_bound(sections.begin(), sections.end(), id,
                                        [](const Section& s, int wanted) { return s.id < wanted; });
    if (found == sections.end() || found->id != id)
        throw std::out_of_range(fmt::format("there is no section {}", id));
    return *found;
}

SeamLayout make_seam_layout(const RunRecord& record) {
    if (!record.complete)
        throw std::runtime_error("it is the record of an unfinished run (finish it with --resume)");
    SeamLayout layout;
    layout.width = record.plan.image.width;
    layout.height = record.plan.image.height;
    layout.region = record.plan.region;
    layout.block = record.plan.block;
    for (const SectionRecord& section : record.sections) layout.sections.push_back(section.section);
    std::sort(layout.sections.begin(), layout.sections.end(),
              [](const Section& p, const Section& q) { return p.id < q.id; });
    check_tiling(layout);
    layout.seams = find_seams(layout.sections);
    layout.controls = control_lines(layout.sections, layout.seams);
    return layout;
}

void SeamDistance::mark(int seam, int x, int distance, bool before) {
    NearSeam& near = row_[static_cast<std::size_t>(x)];
    if (distance > reach || (near.seam >= 0 && near.distance <= distance)) return;
    near = {seam, distance, before};
}

std::span<const NearSeam> SeamDistance::row(int y) {
    row_.assign(static_cast<std::size_t>(layout_->width), {});
    const Rect& region = layout_->region;
    if (y < region.y0 || y >= region.y1) return row_;
    for (int i = 0; i < static_cast<int>(layout_->seams.size()); ++i) {
        const Seam& seam = layout_->seams[static_cast<std::size_t>(i)];
        const int away = seam.vertical ? outside(y, seam.from, seam.to) : across(y, seam.position);
        if (away > reach) continue;
        const int from = seam.vertical ? seam.position - 1 - reach : seam.from - reach;
        const int to = seam.vertical ? seam.position + 1 + reach : seam.to + reach;
        for (int x = std::max(from, region.x0); x < std::min(to, region.x1); ++x) {
            const int here =
                seam.vertical ? across(x, seam.position) : outside(x, seam.from, seam.to);
            const bool before = seam.vertical ? x < seam.position : y < seam.position;
            mark(i, x, std::max(away, here), before);
        }
    }
    return row_;
}

}  // namespace mpipov
