#include "compare_report.h"
#include "json_parts.h"
#include "seams_report.h"

#include <algorithm>
#include <cmath>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

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
              {"detectable", number_json(test.detectable)},
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
            {"radiosity", one.radiosity},
            {"ranks", one.ranks},
            {"shape", to_string(one.shape)},
            {"seams", to_string(one.seams)},
            {"halo", one.halo},
            {"sections", one.sections},
            {"failure", text_json(one.failure)},
            {"image", file_json(one.image, folder)},
            {"run", file_json(one.run_file, folder)},
            {"reference", one.reference},
            {"comparison", one.comparison ? to_json(*one.comparison) : json()},
            {"self_check", self_check_json(one)},
            {"verdict", verdict_json(one)},
            {"seconds", one.seconds}};
}

json conditioning_json(const SeamsScene& scene, const fs::path& folder) {
    json j = to_json(scene.found, folder);
    j["failure"] = text_json(scene.failure);
    return j;
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

json to_json(const SeamsReport& report) {
    json references = json::object(), cases = json::array(), skipped = json::array();
    if (report.serial)
        for (const auto& [name, render] : report.serial->references)
            references[name] = serial_json(render, report.folder);
    for (const SeamsCase& one : report.cases) cases.push_back(case_json(one, report.folder));
    for (const SkippedCase& one : report.skipped)
        skipped.push_back({{"name", one.name}, {"why", one.why}});
    json image;
    if (report.image) image = typed_image_json(*report.image);
    return {{"format", "mpipov-seams"},
            {"version", 1},
            {"scene", report.serial ? report.serial->scene.name : ""},
            {"file", report.serial ? report.serial->scene.file : ""},
            {"arguments", report.arguments},
            {"image", image},
            {"versions", report.versions},
            {"complete", report.complete},
            {"failure", text_json(report.failure)},
            {"effects", effects_json(report.effects)},
            {"references", references},
            {"noise", report.serial ? to_json(report.serial->noise, report.folder) : json()},
            {"conditioning",
             report.conditioning ? conditioning_json(*report.conditioning, report.folder) : json()},
            {"cases", cases},
            {"skipped", skipped}};
}

}  // namespace mpipov
