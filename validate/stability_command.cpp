#include "stability_command.h"

#include "json_output.h"
#include "other_file.h"
#include "render_options.h"
#include "result_file.h"
#include "scratch.h"
#include "stability_measure.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <memory>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

struct StabilityOptions {
    std::string out, json, povray = "povray";
    bool require_well = false;
    SceneRules rules;
};

// Writes stability.json after every render; one that an earlier call left there stays until the
// first.
void measure(const StabilityOptions& options, StabilityReport& report, const fs::path& file) {
    ResultFile result(file,
                      [](const nlohmann::json& earlier) { return !earlier.at("moves").empty(); });
    StabilityRequest request;
    request.arguments = report.arguments;
    request.povray = options.povray;
    request.rules = options.rules;
    request.folder = report.folder / "images";
    request.told = [&] {
        result.replace_earlier();
        result.write(to_json(report));
    };
    measure_into(result, report, [&] {
        report.scene = ask_scene(report.arguments, options.povray, options.rules);
        report.versions["povray"] = report.scene->povray_version;
        const AnswerMap map = measure_stability(request, *report.scene, report.found);
        if (!report.keeps_images) return;
        report.map = report.folder / "answers.png";
        map.write(report.map);
    });
}

Exit run(const CLI::App& app, const StabilityOptions& options) {
    StabilityReport report;
    report.arguments = povray_arguments(app);
    report.versions["mpipov"] = MPIPOV_VERSION;
    require_other_file("--json", options.json == "-" ? "" : options.json,
                       {report.arguments.begin(), report.arguments.end()});
    const ScratchFolder scratch("stability");
    report.keeps_images = !options.out.empty();
    report.folder = report.keeps_images ? make_folder(options.out) : scratch.path();
    measure(options, report, report.folder / "stability.json");
    if (options.json != "-") fmt::print("{}", to_table(report));
    if (!options.json.empty()) write_json(options.json, to_json(report));
    // A picture that never moves shows nothing of its scene.
    const auto& control = report.found.control;
    const bool well =
        is_well(report.found.verdict->kind) && !(control && control->comparison.identical());
    return well || !options.require_well ? Exit::ok : Exit::differ;
}

}  // namespace

Command add_stability_command(CLI::App& program) {
    auto options = std::make_shared<StabilityOptions>();
    CLI::App* app = program.add_subcommand(
        "stability",
        "How well-conditioned a scene is: renders it serially as it is and with the camera moved "
        "by 1e-12, 1e-9 and 1e-6 of its distance from the origin, and says how the picture "
        "answers. The scene's files are not touched. All arguments that are not listed here are "
        "POV-Ray's.");
    pass_on_povray_arguments(*app);
    app->add_option("--out", options->out,
                    "keep the images here, the results as stability.json, and answers.png: the "
                    "brighter, the smaller the move that a pixel answers")
        ->type_name("DIR");
    app->add_option("--json", options->json, "write the results as JSON; - is standard output")
        ->type_name("FILE");
    app->add_flag("--require-well", options->require_well,
                  "exit with 1 unless the scene is well-conditioned");
    app->add_option("--povray", options->povray, "which POV-Ray to run")->capture_default_str();
    add_scene_rules(*app, options->rules);
    app->footer(
        "Exit code: 0 measured, whatever was found; 1 not well-conditioned, with --require-well; 2 "
        "usage, 3 the scene or POV-Ray, also where the camera cannot be moved; 4 a file cannot be "
        "read or written, 5 interrupted.");
    return {app, [app, options] { return run(*app, *options); }};
}

}  // namespace mpipov
