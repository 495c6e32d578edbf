#include "compare_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace mpipov {
namespace {

constexpr std::size_t rows_shown = 12;  // of lists that grow with the number of sections

using Text = std::back_insert_iterator<std::string>;

std::string number(const std::optional<double>& value) {
    return value ? fmt::format("{:.6g}", *value) : "-";
}

std::string box(const Rect& r) {
    return fmt::format("x {}..{}, y {}..{}", r.x0, r.x1 - 1, r.y0, r.y1 - 1);
}

std::string percent(const PixelCounts& counts) {
    if (counts.pixels == 0) return "-";
    return fmt::format("{:.4g} %", 100.0 * static_cast<double>(counts.differing) /
                                       static_cast<double>(counts.pixels));
}

std::string line_name(const Seam& seam) {
    return fmt::format("{} = {}, {} {}..{}", seam.vertical ? "x" : "y", seam.position,
                       seam.vertical ? "y" : "x", seam.from, seam.to - 1);
}

void group_row(Text out, const std::string& name, const GroupErrors& group) {
    fmt::format_to(out, "  {:<14}{:>12}{:>12}{:>12}{:>12}{:>12}\n", name, group.counts.pixels,
                   group.counts.differing, number(group.errors.mean_abs()),
                   number(group.errors.rms()), number(group.errors.max()));
}

void group_heading(Text out, const std::string& title, const std::string& unit) {
    fmt::format_to(out, "\n{} ({})\n  {:<14}{:>12}{:>12}{:>12}{:>12}{:>12}\n", title, unit, "",
                   "pixels", "differing", "mean", "RMS", "largest");
}

// The JSON has every distance; here, those at which something differs.
void distances_text(Text out, const SeamReport& report, const std::string& unit) {
    group_heading(out, "By distance from the nearest seam", unit);
    bool some = false;
    const auto row = [&](const std::string& name, const GroupErrors& group) {
        if (group.counts.differing == 0) return;
        group_row(out, name, group);
        some = true;
    };
    for (std::size_t d = 0; d < report.by_distance.size(); ++d) {
        row(fmt::format("{} before", d), report.by_distance[d].before);
        row(fmt::format("{} after", d), report.by_distance[d].after);
    }
    if (!some) fmt::format_to(out, "  nothing differs up to {}\n", SeamDistance::reach);
    group_row(out, "farther", report.interior);
    if (report.outside.counts.pixels > 0) group_row(out, "not rendered", report.outside);
}

void sections_text(Text out, const SeamReport& report, const std::string& unit) {
    std::vector<const SectionErrors*> differing;
    for (const SectionErrors& section : report.sections)
        if (section.group.counts.differing > 0) differing.push_back(&section);
    std::stable_sort(differing.begin(), differing.end(), [](const auto* p, const auto* q) {
        return p->group.counts.differing > q->group.counts.differing;
    });
    fmt::format_to(out, "\nSections that differ: {} of {}\n", differing.size(),
                   report.sections.size());
    for (std::size_t i = 0; i < std::min(differing.size(), rows_shown); ++i) {
        const SectionErrors& s = *differing[i];
        fmt::format_to(out, "  section {:<5} ({}): {} of {} pixels, largest {} {}, in {}\n",
                       s.section.id, box(s.section.keep), s.group.counts.differing,
                       s.group.counts.pixels, number(s.group.errors.max()), unit,
                       box(s.differing_box));
    }
    if (differing.size() > rows_shown)
        fmt::format_to(out, "  and {} more\n", differing.size() - rows_shown);
}

void seams_text(Text out, const SeamReport& report) {
    std::vector<const SeamErrors*> differing;
    for (const SeamErrors& seam : report.seams)
        if (seam.differing_near > 0) differing.push_back(&seam);
    std::stable_sort(differing.begin(), differing.end(), [](const auto* p, const auto* q) {
        return p->differing_touching > q->differing_touching;
    });
    fmt::format_to(out, "\nSeams with differing pixels near them: {} of {}\n", differing.size(),
                   report.seams.size());
    for (std::size_t i = 0; i < std::min(differing.size(), rows_shown); ++i) {
        const SeamErrors& s = *differing[i];
        fmt::format_to(out, "  {} | {} ({}): {} touching, {} within {} pixels", s.seam.a, s.seam.b,
                       line_name(s.seam), s.differing_touching, s.differing_near,
                       SeamDistance::reach + 1);
        if (s.longest_run.length() > 0)
            fmt::format_to(out, ", longest run {} ({} {}..{})", s.longest_run.length(),
                           s.seam.vertical ? "y" : "x", s.longest_run.from, s.longest_run.to - 1);
        fmt::format_to(out, ", step {} (local {})\n", number(s.step.mean_step),
                       number(s.step.local_step));
    }
    if (differing.size() > rows_shown)
        fmt::format_to(out, "  and {} more\n", differing.size() - rows_shown);
}

void steps_text(Text out, const SeamReport& report, const std::string& unit) {
    fmt::format_to(out,
                   "\nStep of the signed error across a line, {} pixels on each side ({})\n"
                   "  {:<24}{:>8}{:>16}{:>16}\n",
                   StepBuilder::window, unit, "", "lines", "mean step", "local step");
    const auto row = [&](const char* name, const StepSummary& summary) {
        fmt::format_to(out, "  {:<24}{:>8}{:>16}{:>16}\n", name, summary.lines,
                       number(summary.mean_step), number(summary.local_step));
    };
    row("at the seams", report.seam_steps);
    row("midway between them", report.control_steps);
}

void errors_text(Text out, const Comparison& comparison) {
    const ImageFormat& format = comparison.format;
    const Metrics& metrics = comparison.metrics;
    const auto row = [&](const char* name, const std::optional<double>& stored) {
        fmt::format_to(out, "{:<19}{}", name, stored ? number(stored) : "none");
        if (format.integer() && stored)
            fmt::format_to(out, " of {} levels, {:.6g} of full scale", format.full_scale(),
                           *stored / format.full_scale());
        fmt::format_to(out, "\n");
    };
    if (metrics.zero_signs > 0)
        fmt::format_to(out, "sign of zero       {} samples are 0 in one and -0 in the other\n",
                       metrics.zero_signs);
    row("mean error", metrics.all.mean_abs());
    row("mean, signed B - A", metrics.all.mean_signed());
    row("RMS error", metrics.all.rms());
    row("largest error", metrics.all.max());
    if (metrics.largest) {
        const LargestError& at = *metrics.largest;
        fmt::format_to(out, "                   at x {}, y {}, channel {}: A {:.9g}, B {:.9g}\n",
                       at.x, at.y, format.channels[static_cast<std::size_t>(at.channel)], at.a,
                       at.b);
    }
    const auto psnr = comparison.psnr();
    fmt::format_to(out, "PSNR               {}\n",
                   psnr ? fmt::format("{:.4f} dB (peak {})", *psnr, comparison.peak)
                        : std::string(metrics.why_no_psnr()));
}

void ssim_text(Text out, const Ssim& ssim, const ImageFormat& format) {
    if (!ssim.value) {
        fmt::format_to(out, "SSIM               none: {}\n", ssim.reason);
        return;
    }
    fmt::format_to(out, "SSIM               {:.8f}", *ssim.value);
    if (!ssim.reason.empty()) fmt::format_to(out, " ({})", ssim.reason);
    for (std::size_t c = 0; c < ssim.per_channel.size(); ++c)
        fmt::format_to(out, "  {} {:.8f}", format.channels[c], ssim.per_channel[c]);
    fmt::format_to(out, "\n");
}

void nonfinite_text(Text out, const NonFinite& found, const ImageFormat& format) {
    fmt::format_to(out,
                   "not finite         A: {} NaN, {} infinite; B: {} NaN, {} infinite; {} not the "
                   "same in both\n",
                   found.nan_a, found.infinite_a, found.nan_b, found.infinite_b, found.mismatches);
    for (const NonFinitePlace& place : found.first)
        fmt::format_to(out, "                   {} at x {}, y {}, channel {}: {}\n",
                       place.image == 'a' ? "A" : "B", place.x, place.y,
                       format.channels[static_cast<std::size_t>(place.channel)], place.value);
}

}  // namespace

std::string to_table(const SeamReport& report, const std::string& unit) {
    std::string text;
    const Text out = std::back_inserter(text);
    sections_text(out, report, unit);
    seams_text(out, report);
    const BlockEdges& edges = report.block_edges;
    fmt::format_to(out,
                   "\nOn the inner edges of the {}-pixel blocks: {} of {} pixels differ before, {} "
                   "of {} after\n",
                   edges.block, edges.before.differing, edges.before.pixels, edges.after.differing,
                   edges.after.pixels);
    distances_text(out, report, unit);
    steps_text(out, report, unit);
    return text;
}

std::string to_table(const Comparison& comparison) {
    const ImageFormat& format = comparison.format;
    const Metrics& metrics = comparison.metrics;
    const std::string unit = format.integer() ? "levels" : "values";
    std::string text;
    const Text out = std::back_inserter(text);
    fmt::format_to(out, "A  {} ({})\nB  {} ({})\n{} x {} pixels, {}, {}\n\n", comparison.a.string(),
                   format.type, comparison.b.string(), comparison.type_b, format.width,
                   format.height, fmt::join(format.channels, ","), format.depth);
    if (comparison.identical())
        fmt::format_to(out, "identical: no pixel of {} differs\n", metrics.counts.pixels);
    else
        fmt::format_to(out, "differing pixels   {} of {} ({}), in {}\n", metrics.counts.differing,
                       metrics.counts.pixels, percent(metrics.counts), box(metrics.differing_box));
    errors_text(out, comparison);
    if (metrics.nonfinite.total() > 0) nonfinite_text(out, metrics.nonfinite, format);
    if (comparison.ssim) ssim_text(out, *comparison.ssim, format);
    if (comparison.seams && !comparison.identical()) text += to_table(*comparison.seams, unit);
    return text;
}

}  // namespace mpipov
