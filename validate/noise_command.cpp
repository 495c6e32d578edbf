#include "noise_command.h"

#include "json_output.h"
#include "render_options.h"
#include "scratch.h"

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
};

Exit run_noise(const CLI::App& app, const NoiseOptions& options) {
    const std::vector<std::string> arguments = povray_arguments(app);
    const ScratchFolder scratch("noise");
    const fs::path folder = options.out.empty() ? scratch.path() : make_folder(options.out);
    const SceneAsked scene = ask_scene(options.povray, arguments, scratch.path());
    const SerialRenderer renderer(options.povray, arguments, scratch.path());
    const SerialRender reference = renderer.render("serial-default", {}, folder);
    NoiseReport noise =
        find_noise({renderer, reference, options.renders, scene.order_dependent, folder / "noise"});
    compare_noise(noise, reference, {});

    const ImageFormat format = ImageSource(reference.image).format();
    json result = {{"format", "mpipov-noise"},
                   {"version", 1},
                   {"scene", scene.name},
                   {"file", scene.file},
                   {"arguments", arguments},
                   {"image", typed_image_json(format)},
                   {"versions", {{"mpipov", MPIPOV_VERSION}, {"povray", scene.povray_version}}},
                   {"exact", noise.exact},
                   {"noise", to_json(noise, folder)}};
    if (options.out.empty()) {
        // What is gone when the program ends has no name.
        for (auto& render : result["noise"].value("renders", json::array()))
            render["image"] = nullptr;
    }
    if (options.json != "-")
        fmt::print("{}", to_table(noise, format.integer() ? "levels" : "values"));
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
    app->add_option("--out", options->out, "keep the images here, and the results as noise.json")
        ->type_name("DIR");
    app->add_option("--json", options->json, "write the results as JSON; - is standard output")
        ->type_name("FILE");
    app->add_option("--povray", options->povray, "which POV-Ray to run")->capture_default_str();
    app->footer(
        "Exit code: 0 ok, 2 usage, 3 the scene or POV-Ray, 4 a file cannot be read or written, 5 "
        "interrupted.");
    return {app, [app, options] { return run_noise(*app, *options); }};
}

}  // namespace mpipov
