#include "json_parts.h"
#include "stability_report.h"

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json move_json(const CameraMove& one, const fs::path& folder) {
    const Metrics& metrics = one.comparison.metrics;
    return {{"move", one.move},
            {"image", file_json(one.render.image, folder)},
            {"argv", one.render.argv},
            {"seconds", one.render.wall_seconds},
            {"cpu_seconds", one.render.cpu_seconds},
            {"pixels", metrics.counts.pixels},
            {"differing", metrics.counts.differing},
            {"answering", one.answering},
            {"mean", number_json(metrics.all.mean_abs())},
            {"rms", number_json(metrics.all.rms())},
            {"largest", number_json(metrics.all.max())},
            {"nonfinite", metrics.nonfinite.total()},
            {"amplification", number_json(one.amplification())}};
}

void without_images(json& found) {
    found["reference"]["image"] = nullptr;
    for (json& one : found["moves"]) one["image"] = nullptr;
    if (!found["control"].is_null()) found["control"]["image"] = nullptr;
}

}  // namespace

std::string to_string(CameraWay way) {
    switch (way) {
        case CameraWay::scale:
            return "scale";
        case CameraWay::shift:
            return "shift";
        case CameraWay::declared:
            break;
    }
    return "declared";
}

std::optional<double> CameraMove::amplification() const {
    const auto rms = comparison.metrics.all.rms();
    if (!rms || !(move > 0)) return {};
    return *rms / comparison.format.full_scale() / move;
}

json to_json(const Stability& found, const fs::path& folder) {
    json all = json::array();
    for (const CameraMove& one : found.moves) all.push_back(move_json(one, folder));
    json verdict;
    if (found.verdict)
        verdict = {{"verdict", to_string(found.verdict->kind)},
                   {"well", is_well(found.verdict->kind)},
                   {"why", found.verdict->why}};
    json reference;
    if (!found.reference.image.empty()) reference = serial_json(found.reference, folder);
    return {{"reference", reference},
            {"cameras", found.cameras},
            {"moved_by", to_string(found.way)},
            {"moves", all},
            {"control", found.control ? move_json(*found.control, folder) : json()},
            {"noise_mean", number_json(found.noise)},
            {"verdict", verdict}};
}

json to_json(const StabilityReport& report) {
    json j = to_json(report.found, report.folder);
    if (!report.keeps_images) without_images(j);
    json image;
    if (!report.found.moves.empty())
        image = typed_image_json(report.found.moves.front().comparison.format);
    j.update({{"format", "mpipov-stability"},
              {"version", 1},
              {"scene", report.scene ? report.scene->name : ""},
              {"file", report.scene ? report.scene->file : ""},
              {"arguments", report.arguments},
              {"image", image},
              {"versions", report.versions},
              {"order_dependent", report.scene && report.scene->order_dependent},
              {"complete", report.complete},
              {"failure", text_json(report.failure)},
              {"map", file_json(report.map, report.folder)}});
    return j;
}

}  // namespace mpipov
