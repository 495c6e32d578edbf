#include "seam_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace mpipov {

SeamProfileBuilder::SeamProfileBuilder(SeamLayout layout, const ImageShape& shape)
    : shape_(shape),
      distance_(report_.layout),
      differs_(static_cast<std::size_t>(shape.width)),
      previous_(static_cast<std::size_t>(shape.width)) {
    if (layout.width != shape.width || layout.height != shape.height)
        throw std::invalid_argument(fmt::format("the run rendered {} x {} pixels, not {} x {}",
                                                layout.width, layout.height, shape.width,
                                                shape.height));
    report_.layout = std::move(layout);
    report_.block_edges.block = report_.layout.block;
    for (const Section& section : report_.layout.sections)
        report_.sections.push_back({section, {}, {}});
    const auto steps = [&](const std::vector<Seam>& lines) {
        std::vector<StepBuilder> builders;
        builders.reserve(lines.size());
        for (const Seam& line : lines)
            builders.emplace_back(line, report_.layout.section(line.a).keep,
                                  report_.layout.section(line.b).keep, shape);
        return builders;
    };
    seam_steps_ = steps(report_.layout.seams);
    control_steps_ = steps(report_.layout.controls);
    for (const Seam& seam : report_.layout.seams) report_.seams.push_back({seam, 0, 0, {}, {}});
    open_run_.assign(report_.seams.size(), -1);
}

void SeamProfileBuilder::add_pixels(GroupErrors& group, std::span<const double> a,
                                    std::span<const double> b, int x0, int x1) {
    const auto channels = static_cast<std::size_t>(shape_.channels);
    for (int x = x0; x < x1; ++x) {
        const std::size_t at = static_cast<std::size_t>(x) * channels;
        ++group.counts.pixels;
        group.counts.differing += differs_[static_cast<std::size_t>(x)];
        for (std::size_t i = at; i < at + channels; ++i) group.errors.add(a[i], b[i]);
    }
}

void SeamProfileBuilder::add_sections(int y, std::span<const double> a, std::span<const double> b) {
    for (SectionErrors& section : report_.sections) {
        const Rect& keep = section.section.keep;
        if (y < keep.y0 || y >= keep.y1) continue;
        const long long before = section.group.counts.differing;
        add_pixels(section.group, a, b, keep.x0, keep.x1);
        if (section.group.counts.differing == before) continue;
        const auto begin = differs_.begin() + keep.x0, end = differs_.begin() + keep.x1;
        const auto first = static_cast<int>(std::find(begin, end, 1) - differs_.begin());
        int last = keep.x1;
        while (differs_[static_cast<std::size_t>(last - 1)] == 0) --last;
        Rect& box = section.differing_box;
        box = before == 0 ? Rect{first, y, last, y + 1}
                          : Rect{std::min(box.x0, first), box.y0, std::max(box.x1, last), y + 1};
    }
}

void SeamProfileBuilder::add_distances(int y, std::span<const double> a,
                                       std::span<const double> b) {
    const std::span<const NearSeam> near = distance_.row(y);
    for (int x = 0; x < shape_.width; ++x) {
        const NearSeam& here = near[static_cast<std::size_t>(x)];
        GroupErrors* group = &report_.interior;
        if (!report_.layout.region.contains(x, y)) {
            group = &report_.outside;
        } else if (here.seam >= 0) {
            auto& sides = report_.by_distance[static_cast<std::size_t>(here.distance)];
            group = here.before ? &sides.before : &sides.after;
            if (differs_[static_cast<std::size_t>(x)] != 0)
                ++report_.seams[static_cast<std::size_t>(here.seam)].differing_near;
        }
        add_pixels(*group, a, b, x, x + 1);
    }
}

void SeamProfileBuilder::extend_run(std::size_t seam, int place, bool differs) {
    int& open = open_run_[seam];
    if (!differs) {
        open = -1;
        return;
    }
    if (open < 0) open = place;
    SeamRun& longest = report_.seams[seam].longest_run;
    if (place + 1 - open > longest.length()) longest = {open, place + 1};
}

void SeamProfileBuilder::add_runs(int y) {
    for (std::size_t i = 0; i < report_.seams.size(); ++i) {
        const Seam& seam = report_.seams[i].seam;
        const auto touch = [&](int place, char before, char after) {
            report_.seams[i].differing_touching += before + after;
            extend_run(i, place, before + after > 0);
        };
        const auto position = static_cast<std::size_t>(seam.position);
        if (seam.vertical && y >= seam.from && y < seam.to)
            touch(y, differs_[position - 1], differs_[position]);
        if (!seam.vertical && y == seam.position)
            for (int x = seam.from; x < seam.to; ++x)
                touch(x, previous_[static_cast<std::size_t>(x)],
                      differs_[static_cast<std::size_t>(x)]);
    }
}

void SeamProfileBuilder::add_block_edges(int y) {
    const Rect& region = report_.layout.region;
    BlockEdges& edges = report_.block_edges;
    if (edges.block < 1 || y < region.y0 || y >= region.y1) return;
    const auto after = [&](int p, int from) { return p > from && (p - from) % edges.block == 0; };
    const auto before = [&](int p, int from, int to) {
        return p + 1 < to && (p + 1 - from) % edges.block == 0;
    };
    const bool row_after = after(y, region.y0), row_before = before(y, region.y0, region.y1);
    for (int x = region.x0; x < region.x1; ++x) {
        const char differs = differs_[static_cast<std::size_t>(x)];
        const auto count = [&](PixelCounts& counts) {
            ++counts.pixels;
            counts.differing += differs;
        };
        if (row_after || after(x, region.x0)) count(edges.after);
        if (row_before || before(x, region.x0, region.x1)) count(edges.before);
    }
}

void SeamProfileBuilder::add_row(int y, std::span<const double> a, std::span<const double> b) {
    std::swap(differs_, previous_);
    const auto channels = static_cast<std::size_t>(shape_.channels);
    for (std::size_t x = 0; x < differs_.size(); ++x)
        differs_[x] = pixel_differs(&a[x * channels], &b[x * channels], shape_.channels) ? 1 : 0;
    add_sections(y, a, b);
    add_distances(y, a, b);
    add_runs(y);
    add_block_edges(y);
    for (StepBuilder& step : seam_steps_) step.add_row(y, a, b);
    for (StepBuilder& step : control_steps_) step.add_row(y, a, b);
}

SeamReport SeamProfileBuilder::finish() {
    std::vector<LineStep> steps;
    for (std::size_t i = 0; i < seam_steps_.size(); ++i) {
        report_.seams[i].step = seam_steps_[i].result();
        steps.push_back(report_.seams[i].step);
    }
    for (const StepBuilder& step : control_steps_) report_.controls.push_back(step.result());
    report_.seam_steps = summarize(steps);
    report_.control_steps = summarize(report_.controls);
    return std::move(report_);
}

}  // namespace mpipov
