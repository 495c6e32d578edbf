#include "compare_report.h"
#include "json_parts.h"
#include "seams_report.h"

#include <algorithm>
#include <cmath>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json text(const std::string& value) {
    return value.empty() ? json() : json(value);
}

json file_in(const fs::path& file, const fs::path& folder) {
    if (file.empty()) return nullptr;
    const fs::path inside = file.lexically_relative(folder);
    return inside.empty() || *inside.begin() == ".." ? file.string() : inside.string();
}

json serial_json(const SerialRender& render, const fs::path& folder) {
    return {{"image", file_in(render.image, folder)},
            {"argv", render.argv},
            {"seconds", render.wall_seconds},
            {"cpu_seconds", render.cpu_seconds}};
}

std::optional<double> mean_abs_at(const SeamReport& report, std::size_t distance) {
    const auto& [before, after] = report.by_distance[distance];
    const auto samples = static_cast<double>(before.errors.samples() + after.errors.samples());
    if (samples == 0) return {};
    return (before.errors.mean_abs().value_or(0) * static_cast<double>(before.errors.samples()) +
            after.errors.mean_abs().value_or(0) * static_cast<double>(after.errors.samples())) /
           samples;
}

json distances_json(const std::vector<NoiseRender>& renders) {
    json list = json::array();
    for (std::size_t d = 0; d <= SeamDistance::reach; ++d) {
        std::optional<double> low, high;
        for (const NoiseRender& render : renders) {
            if (!render.comparison.seams) return json::array();
            const auto mean = mean_abs_at(*render.comparison.seams, d);
            if (!mean) continue;
            low = std::min(low.value_or(*mean), *mean);
            high = std::max(high.value_or(*mean), *mean);
        }
        list.push_back({{"distance", d}, {"low", number_json(low)}, {"high", number_json(high)}});
    }
    return list;
}

json render_json(const NoiseRender& render, const fs::path& folder) {
    const Comparison& found = render.comparison;
    json j = serial_json(render.render, folder);
    const auto* seams = found.seams ? &*found.seams : nullptr;
    j.update({{"name", render.render.name},
              {"mean", number_json(found.metrics.all.mean_abs())},
              {"rms", number_json(found.metrics.all.rms())},
              {"max", number_json(found.metrics.all.max())},
              {"differing_pixels", found.metrics.counts.differing},
              {"mean_step", seams ? number_json(seams->seam_steps.mean_step) : json()},
              {"local_step", seams ? number_json(seams->seam_steps.local_step) : json()}});
    return j;
}

json pixel_json(const PixelTest& test, const ImageFormat& format) {
    json at;
    if (test.at)
        at = {
            {"x", test.at->x},
            {"y", test.at->y},
            {"channel", format.channels[static_cast<std::size_t>(test.at->channel)]},
            {"value", number_json(test.at->value)},
            {"mean", number_json(test.at->expected)},
            {"sigma", number_json(test.at->sigma)},
            {"seam_distance", test.at->seam_distance < 0 ? json() : json(test.at->seam_distance)}};
    json sections = json::object();
    for (const auto& [id, count] : test.beyond_by_section) sections[std::to_string(id)] = count;
    return {{"alpha", test.alpha},
            {"alpha_sidak", test.alpha_sidak},
            {"samples", test.samples},
            {"renders", test.renders},
            {"largest_z", number_json(test.largest)},
            {"critical_z", test.critical},
            {"at", at},
            {"beyond", test.beyond},
            {"beyond_near", test.beyond_near},
            {"near", PixelTest::near},
            {"beyond_box", rect_json(test.beyond_box)},
            {"beyond_by_section", sections}};
}

json step_json(const StepTest& test, const ImageFormat& format) {
    json j = {{"alpha", test.alpha},
              {"alpha_sidak", test.alpha_sidak},
              {"tests", test.tests},
              {"renders", test.renders},
              {"largest", number_json(test.largest)},
              {"critical", test.critical},
              {"seam", nullptr},
              {"line", nullptr},
              {"channel", nullptr},
              {"step", number_json(test.step)},
              {"expected", number_json(test.expected)},
              {"beyond", test.beyond},
              {"controls_beyond", test.controls_beyond},
              {"together", nullptr}};
    if (test.at) {
        j["seam"] = test.at->seam;
        j["channel"] = format.channels[static_cast<std::size_t>(test.at->channel)];
        j["line"] = line_json(test.at->line);
    }
    if (test.together)
        j["together"] = {{"mean", test.together->mean},
                         {"expected", test.together->expected},
                         {"z", test.together->z},
                         {"critical", test.together->critical}};
    return j;
}

json verdict_json(const SeamsCase& one) {
    json j = {{"verdict", to_string(one.verdict.kind)},
              {"ok", one.verdict.ok},
              {"why", one.verdict.why},
              {"pixel_test", nullptr},
              {"step_test", nullptr},
              {"quiet", nullptr}};
    if (one.judgement && one.comparison) {
        const QuietRate& quiet = one.judgement->quiet;
        j["pixel_test"] = pixel_json(one.judgement->pixel, one.comparison->format);
        j["step_test"] = step_json(one.judgement->step, one.comparison->format);
        j["quiet"] = {{"renders", quiet.renders},
                      {"pixel_alarms", quiet.pixel_alarms},
                      {"step_alarms", quiet.step_alarms},
                      {"alarms", quiet.alarms}};
    }
    return j;
}

json self_check_json(const SeamsCase& one) {
    if (!one.run) return nullptr;
    int checked = 0, disagreed = 0, found = 0;
    for (const SeamRecord& seam : one.run->seams) {
        checked += seam.checked ? 1 : 0;
        disagreed += seam.differing > 0 ? 1 : 0;
    }
    if (one.comparison && one.comparison->seams)
        for (const SeamErrors& seam : one.comparison->seams->seams)
            found += seam.differing_touching > 0 ? 1 : 0;
    return {{"seams", one.run->seams.size()},
            {"checked", checked},
            {"disagreed", disagreed},
            {"repaired", one.run->repairs.size()},
            {"would_catch", found}};
}

json case_json(const SeamsCase& one, const fs::path& folder) {
    return {{"name", one.name},
            {"schedule", one.schedule},
            {"ranks", one.ranks},
            {"shape", to_string(one.shape)},
            {"seams", to_string(one.seams)},
            {"halo", one.halo},
            {"sections", one.sections},
            {"failure", text(one.failure)},
            {"image", file_in(one.image, folder)},
            {"run", file_in(one.run_file, folder)},
            {"reference", one.reference},
            {"comparison", one.comparison ? to_json(*one.comparison) : json()},
            {"self_check", self_check_json(one)},
            {"verdict", verdict_json(one)},
            {"seconds", one.seconds}};
}

json effects_json(const std::map<std::string, Effect>& effects) {
    json j = json::object();
    for (const auto& [name, effect] : effects)
        j[name] = {{"on", effect.on},
                   {"why", effect.why},
                   {"cpu_seconds", number_json(effect.cpu_seconds)}};
    return j;
}

}  // namespace

json typed_image_json(const ImageFormat& format) {
    json j = image_json(format);
    j["type"] = format.type;
    return j;
}

json to_json(const NoiseReport& noise, const fs::path& folder) {
    if (noise.renders.empty()) return {{"why_not", noise.why_not}, {"tried", noise.tried}};
    json renders = json::array();
    Welford means;
    double low = 0, high = 0;
    for (const NoiseRender& render : noise.renders) {
        renders.push_back(render_json(render, folder));
        const auto mean = render.comparison.metrics.all.mean_abs();
        if (!mean) continue;
        low = means.count() == 0 ? *mean : std::min(low, *mean);
        high = means.count() == 0 ? *mean : std::max(high, *mean);
        means.add(*mean);
    }
    json j = {{"renders", renders},
              {"tried", noise.tried},
              {"mean", {{"low", low}, {"high", high}, {"mean", means.mean()}}},
              {"by_distance", distances_json(noise.renders)},
              {"sigma", nullptr}};
    if (!noise.why_not.empty()) j["why_not_enough"] = noise.why_not;
    if (noise.floor) {
        const NoiseFloor& floor = *noise.floor;
        j["sigma"] = number_json(floor.sigma);
        j["largest_sigma"] = {
            {"sigma", floor.largest_sigma},
            {"x", floor.x},
            {"y", floor.y},
            {"channel", noise.renders.front()
                            .comparison.format.channels[static_cast<std::size_t>(floor.channel)]}};
        j["noisy_samples"] = floor.noisy;
        j["samples"] = floor.samples;
    }
    return j;
}

json to_json(const SeamsReport& report) {
    json references = json::object(), cases = json::array(), skipped = json::array();
    for (const auto& [name, render] : report.references)
        references[name] = serial_json(render, report.folder);
    for (const SeamsCase& one : report.cases) cases.push_back(case_json(one, report.folder));
    for (const SkippedCase& one : report.skipped)
        skipped.push_back({{"name", one.name}, {"why", one.why}});
    json image;
    if (report.image) image = typed_image_json(*report.image);
    return {{"format", "mpipov-seams"},
            {"version", 1},
            {"scene", report.scene},
            {"file", report.file},
            {"arguments", report.arguments},
            {"image", image},
            {"versions", report.versions},
            {"complete", report.complete},
            {"failure", text(report.failure)},
            {"effects", effects_json(report.effects)},
            {"references", references},
            {"noise", report.noise ? to_json(*report.noise, report.folder) : json()},
            {"cases", cases},
            {"skipped", skipped}};
}

}  // namespace mpipov
