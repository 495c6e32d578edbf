#include "compare_report.h"
#include "json_parts.h"

#include <cmath>

namespace mpipov {
namespace {

using nlohmann::json;

json counts_json(const PixelCounts& counts) {
    return {{"pixels", counts.pixels}, {"differing", counts.differing}};
}

json errors_json(const ErrorSums& errors) {
    return {{"mean_abs", number_json(errors.mean_abs())},
            {"mean_signed", number_json(errors.mean_signed())},
            {"rms", number_json(errors.rms())},
            {"max", number_json(errors.max())}};
}

json group_json(const GroupErrors& group) {
    json j = counts_json(group.counts);
    j.update(errors_json(group.errors));
    return j;
}

json step_json(const LineStep& step) {
    json channels = json::array();
    for (const auto& channel : step.channels) channels.push_back(number_json(channel));
    return {{"mean_step", number_json(step.mean_step)},
            {"local_step", number_json(step.local_step)},
            {"channels", channels}};
}

json summary_json(const StepSummary& summary) {
    return {{"lines", summary.lines},
            {"mean_step", number_json(summary.mean_step)},
            {"local_step", number_json(summary.local_step)}};
}

json nonfinite_json(const NonFinite& found, const ImageFormat& format) {
    json first = json::array();
    for (const NonFinitePlace& place : found.first)
        first.push_back({{"image", std::string(1, place.image)},
                         {"x", place.x},
                         {"y", place.y},
                         {"channel", format.channels[static_cast<std::size_t>(place.channel)]},
                         {"value", std::isnan(place.value) ? "nan"
                                   : place.value > 0       ? "inf"
                                                           : "-inf"}});
    return {{"a", {{"nan", found.nan_a}, {"infinite", found.infinite_a}}},
            {"b", {{"nan", found.nan_b}, {"infinite", found.infinite_b}}},
            {"mismatches", found.mismatches},
            {"first", first}};
}

json ssim_json(const std::optional<Ssim>& ssim, const ImageFormat& format) {
    if (!ssim) return nullptr;
    json channels = json::object();
    for (std::size_t c = 0; c < ssim->per_channel.size(); ++c)
        channels[format.channels[c]] = ssim->per_channel[c];
    return {{"value", number_json(ssim->value)},
            {"per_channel", channels},
            {"reason", ssim->reason.empty() ? json() : json(ssim->reason)}};
}

}  // namespace

json to_json(const SeamReport& report) {
    json distances = json::array(), sections = json::array(), seams = json::array(),
         controls = json::array();
    for (std::size_t d = 0; d < report.by_distance.size(); ++d)
        distances.push_back({{"distance", d},
                             {"before", group_json(report.by_distance[d].before)},
                             {"after", group_json(report.by_distance[d].after)}});
    for (const SectionErrors& section : report.sections) {
        json j = group_json(section.group);
        j.update({{"id", section.section.id},
                  {"keep", rect_json(section.section.keep)},
                  {"differing_box", rect_json(section.differing_box)}});
        sections.push_back(j);
    }
    for (const SeamErrors& seam : report.seams) {
        json j = line_json(seam.seam);
        const SeamRun& run = seam.longest_run;
        j.update({{"differing_touching", seam.differing_touching},
                  {"differing_near", seam.differing_near},
                  {"longest_run",
                   run.length() == 0
                       ? json()
                       : json{{"from", run.from}, {"to", run.to}, {"length", run.length()}}},
                  {"step", step_json(seam.step)}});
        seams.push_back(j);
    }
    for (const LineStep& control : report.controls) {
        json j = line_json(control.line);
        j.update({{"section", control.line.a}, {"step", step_json(control)}});
        j.erase("a");
        j.erase("b");
        controls.push_back(j);
    }
    return {{"region", rect_json(report.layout.region)},
            {"by_distance", distances},
            {"interior", group_json(report.interior)},
            {"outside", group_json(report.outside)},
            {"sections", sections},
            {"seams", seams},
            {"controls", controls},
            {"step",
             {{"window", StepBuilder::window},
              {"seams", summary_json(report.seam_steps)},
              {"controls", summary_json(report.control_steps)}}},
            {"block_edges",
             {{"block", report.block_edges.block},
              {"before", counts_json(report.block_edges.before)},
              {"after", counts_json(report.block_edges.after)}}}};
}

json to_json(const Comparison& comparison) {
    const ImageFormat& format = comparison.format;
    const Metrics& metrics = comparison.metrics;
    const auto both = [&](const std::optional<double>& stored) -> json {
        if (!stored) return nullptr;
        return {{"levels", format.integer() ? json(*stored) : json()},
                {"full_scale", *stored / format.full_scale()}};
    };
    json largest;
    if (metrics.largest) {
        const LargestError& at = *metrics.largest;
        largest = both(at.b - at.a);
        largest.update({{"x", at.x},
                        {"y", at.y},
                        {"channel", format.channels[static_cast<std::size_t>(at.channel)]},
                        {"a", at.a},
                        {"b", at.b}});
    }
    json channels = json::array();
    for (std::size_t c = 0; c < metrics.channels.size(); ++c) {
        json j = errors_json(metrics.channels[c]);
        j["name"] = format.channels[c];
        channels.push_back(j);
    }
    return {{"format", "mpipov-compare"},
            {"version", 1},
            {"a", {{"file", comparison.a.string()}, {"type", format.type}}},
            {"b", {{"file", comparison.b.string()}, {"type", comparison.type_b}}},
            {"image", image_json(format)},
            {"unit", format.integer() ? "level" : "value"},
            {"full_scale", format.full_scale()},
            {"identical", comparison.identical()},
            {"pixels", metrics.counts.pixels},
            {"differing", metrics.counts.differing},
            {"differing_box", rect_json(metrics.differing_box)},
            {"zero_signs", metrics.zero_signs},
            {"mean_abs", both(metrics.all.mean_abs())},
            {"mean_signed", both(metrics.all.mean_signed())},
            {"rms", both(metrics.all.rms())},
            {"psnr", number_json(comparison.psnr())},
            {"psnr_reason", text_json(std::string(metrics.why_no_psnr()))},
            {"peak", comparison.peak},
            {"largest", largest},
            {"channels", channels},
            {"nonfinite", nonfinite_json(metrics.nonfinite, format)},
            {"ssim", ssim_json(comparison.ssim, format)},
            {"run", comparison.seams ? to_json(*comparison.seams) : json()}};
}

}  // namespace mpipov
