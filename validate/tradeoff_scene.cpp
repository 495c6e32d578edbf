#include "tradeoff_scene.h"

#include "file_text.h"
#include "job_identity.h"
#include "povray_command.h"
#include "probe.h"
#include "scene_effects.h"

#include <fmt/format.h>

#include <algorithm>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

bool mentions_size(const fs::path& file) {
    const std::string text = text_of(file);
    return text.find("image_width") != std::string::npos ||
           text.find("image_height") != std::string::npos;
}

}  // namespace

void ask_scene(const std::string& povray, const fs::path& scratch, const Confinement& confinement,
               TradeoffReport& report) {
    report.versions["povray"] = povray_version(povray);
    const Probe probe =
        run_probe({povray, quote_arguments(report.arguments), scratch, {}, {}, confinement});
    const ImageOptions& image = probe.result.image;
    report.file = image.input_file;
    report.scene = fs::path(image.input_file).stem().string();
    report.region = image.region;
    report.width = image.width;
    report.height = image.height;
    report.identity = job_identity(probe, report.arguments, report.versions.at("povray"));
    for (const auto& [name, effect] : find_effects(probe.result)) report.effects[name] = effect.on;
    report.calls = {probe.result.report.antialiasing, probe.result.report.radiosity,
                    report.effects.at("order_dependent"), std::max(image.width, image.height)};
    for (const fs::path& file : files_of_scene(report.identity))
        if (mentions_size(file))
            report.notes.push_back(fmt::format(
                "'{}' asks for image_width or image_height: at the size of the truth it may "
                "be another scene",
                file.string()));
    if (report.calls.radiosity)
        report.notes.emplace_back(
            "the truth's radiosity is the scene's own settings with a cache of its own from "
            "many times as many pixels: not what other radiosity settings would give");
}

}  // namespace mpipov
