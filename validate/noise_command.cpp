#include "noise_command.h"

#include "json_output.h"
#include "other_file.h"
#include "render_options.h"
#include "scratch.h"
#include "seams_report.h"
#include "serial_stage.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <memory>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct NoiseOptions {
    std::string out, json, povray = "povray";
    int renders = default_noise_renders;
    SceneRules rules;
};

Exit run_noise(const CLI::App& app, const NoiseOptions& options) {
    SerialRequest request{povray_arguments(app), options.renders, options.povray, false,
                          options.rules};
    // Kept, it is for `seams --serial`, which may ask for halo.
    request.one_block = !options.out.empty();
    require_other_file("--json", options.json == "-" ? "" : options.json,
                       {request.arguments.begin(), request.arguments.end()});
    const ScratchFolder scratch("noise");
    const fs::path folder = options.out.empty() ? scratch.path() : make_folder(options.out);
    const SerialStage stage(folder);
    SerialSet set = render_serial_set(request, stage.path());
    // An earlier noise.json must not name images of this scene, should the rest fail.
    std::error_code ignored;
    fs::remove(folder / "noise.json", ignored);
    stage.keep(set);
    json result = to_json(set, request, folder);
    if (options.out.empty()) {
        // What is gone when the program ends has no name.
        for (auto& render : result["noise"].value("renders", json::array()))
            render["image"] = nullptr;
        for (auto& reference : result["references"]) reference["image"] = nullptr;
    }
    const bool levels = ImageSource(set.reference().image).format().integer();
    if (options.json != "-") fmt::print("{}", to_table(set.noise, levels ? "levels" : "values"));
    if (!options.json.empty()) write_json(options.json, result);
    if (!options.out.empty()) write_json((folder / "noise.json").string(), result);
    return Exit::ok;
}

}  // namespace

Command add_noise_command(CLI::App& program) {
    auto options = std::make_shared<NoiseOptions>();
    CLI::App* app = program.add_subcommand(
        "noise",
        "The scene's own noise floor: how far serial renders in other, equally right orders lie "
        "from each other. All arguments that are not listed here are POV-Ray's.");
    pass_on_povray_arguments(*app);
    app->add_option("--renders", options->renders, "how many renders beside the serial one")
        ->check(CLI::Range(fewest_noise_renders, 1000))
        ->capture_default_str();
    app->add_option("--out", options->out,
                    "keep the images here, and the results as noise.json: for seams --serial")
        ->type_name("DIR");
    app->add_option("--json", options->json, "write the results as JSON; - is standard output")
        ->type_name("FILE");
    app->add_option("--povray", options->povray, "which POV-Ray to run")->capture_default_str();
    add_scene_rules(*app, options->rules);
    app->footer(
        "Exit code: 0 ok, 2 usage, 3 the scene or POV-Ray, 4 a file cannot be read or written, 5 "
        "interrupted.");
    return {app, [app, options] { return run_noise(*app, *options); }};
}

}  // namespace mpipov
