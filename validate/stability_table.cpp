#include "stability_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>

namespace mpipov {
namespace {

std::string number(const std::optional<double>& value) {
    return value ? fmt::format("{:.4g}", *value) : "-";
}

std::string way_of(CameraWay way) {
    switch (way) {
        case CameraWay::scale:
            return "the camera's place times 1 + move";
        case CameraWay::shift:
            return "the camera shifted by so much of a unit of the scene: it is at the origin, or "
                   "the "
                   "picture is the same from anywhere on the line to the origin";
        case CameraWay::declared:
            break;
    }
    return "Mpipov_Camera_Move declared, which the scene uses itself";
}

void row(std::back_insert_iterator<std::string> out, const CameraMove& one, const char* note) {
    const Metrics& metrics = one.comparison.metrics;
    const long long bad = metrics.nonfinite.total();
    fmt::format_to(out, "  {:<7}{:>10}{:>11}{:>11}{:>11}{:>11}{:>15}{}{}\n", move_text(one.move),
                   metrics.counts.differing, one.answering, number(metrics.all.mean_abs()),
                   number(metrics.all.rms()), number(metrics.all.max()),
                   number(one.amplification()), note,
                   bad > 0 ? fmt::format("  {} samples are not finite", bad) : "");
}

}  // namespace

std::string to_table(const StabilityReport& report) {
    std::string text;
    const auto out = std::back_inserter(text);
    const Stability& found = report.found;
    fmt::format_to(out, "{}", report.scene ? report.scene->name : "no scene");
    if (!found.moves.empty()) {
        const ImageFormat& image = found.moves.front().comparison.format;
        fmt::format_to(out, ", {} x {} pixels, {}, {}; errors in {}", image.width, image.height,
                       fmt::join(image.channels, ","), image.depth,
                       image.integer() ? "levels" : "values");
    }
    fmt::format_to(out, "\n\n  {:<7}{:>10}{:>11}{:>11}{:>11}{:>11}{:>15}\n", "move", "differing",
                   "answering", "mean", "RMS", "largest", "amplification");
    for (const CameraMove& one : found.moves) row(out, one, "");
    if (found.control) row(out, *found.control, "  (control)");
    if (found.verdict)
        fmt::format_to(out, "\n{}: {}\n", to_string(found.verdict->kind), found.verdict->why);
    if (found.control && found.control->comparison.identical())
        fmt::format_to(out, "Not even a move of {} changes the picture: that shows nothing.\n",
                       move_text(found.control->move));
    fmt::format_to(out,
                   "\nMoved: {}. answering: pixels that change by more than one level of 255. "
                   "amplification: RMS as part of full scale, divided by the move.\n",
                   way_of(found.way));
    return text;
}

}  // namespace mpipov
