#include "json_parts.h"
#include "serial_set.h"

#include <algorithm>

namespace mpipov {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

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
    j.update({{"mean", number_json(found.metrics.all.mean_abs())},
              {"rms", number_json(found.metrics.all.rms())},
              {"max", number_json(found.metrics.all.max())},
              {"differing_pixels", found.metrics.counts.differing},
              {"mean_step", seams ? number_json(seams->seam_steps.mean_step) : json()},
              {"local_step", seams ? number_json(seams->seam_steps.local_step) : json()}});
    return j;
}

}  // namespace

json serial_json(const SerialRender& render, const fs::path& folder) {
    return {{"name", render.name},
            {"image", file_json(render.image, folder)},
            {"argv", render.argv},
            {"seconds", render.wall_seconds},
            {"cpu_seconds", render.cpu_seconds}};
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

json to_json(const SerialSet& set, const SerialRequest& request, const fs::path& folder) {
    json references = json::object();
    for (const auto& [name, render] : set.references)
        references[name] = serial_json(render, folder);
    const SceneAsked& scene = set.scene;
    return {{"format", "mpipov-noise"},
            {"version", 1},
            {"scene", scene.name},
            {"file", scene.file},
            {"identity", scene.identity},
            {"arguments", request.arguments},
            {"image", typed_image_json(ImageSource(set.reference().image).format())},
            {"versions", {{"mpipov", MPIPOV_VERSION}, {"povray", scene.povray_version}}},
            {"order_dependent", scene.order_dependent},
            {"longest_side", scene.longest_side},
            {"method_1", sees_blocks(set.reference().report)},
            {"exact", set.noise.exact},
            {"wanted", request.renders},
            {"references", references},
            {"noise", to_json(set.noise, folder)}};
}

}  // namespace mpipov
