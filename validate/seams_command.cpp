#include "seams_command.h"

#include "render_options.h"
#include "seams_run.h"
#include "shipped_file.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <memory>

namespace mpipov {
namespace {

struct SeamsOptions {
    std::string out, serial, ranks = "1,2", schedule = "dynamic", shape = "columns",
                             seams = "aligned,halo:2,plain", sections = "2,8,32",
                             radiosity = "auto", povray = "povray", mpiexec = "mpiexec";
    int renders = default_noise_renders;
    bool conditioning = true;
    SceneRules rules;
};

const std::vector<Shape> shapes{Shape::columns, Shape::rows, Shape::tiles};

std::vector<SeamKind> seams_of(const std::string& text) {
    constexpr int default_halo = 2;
    std::vector<SeamKind> kinds;
    for (const std::string& piece : split_list("--seams", text)) {
        if (piece == "aligned")
            kinds.push_back({Seams::aligned, 0});
        else if (piece == "plain")
            kinds.push_back({Seams::plain, 0});
        else if (piece == "halo")
            kinds.push_back({Seams::halo, default_halo});
        else if (piece.rfind("halo:", 0) == 0)
            kinds.push_back({Seams::halo, split_numbers("--seams halo", piece.substr(5)).front()});
        else
            throw Failure(Exit::usage,
                          fmt::format("--seams: '{}' is not one of aligned, halo:N, plain", piece));
    }
    return kinds;
}

Exit run(const CLI::App& app, const SeamsOptions& options) {
    SeamsRequest request;
    request.arguments = povray_arguments(app);
    request.schedules = each_once(split_names("--schedule", options.schedule, schedules));
    request.ranks = each_once(split_numbers("--ranks", options.ranks));
    request.shapes = each_once(split_names("--shape", options.shape, shapes));
    request.seams = each_once(seams_of(options.seams));
    request.sections = each_once(split_numbers("--sections", options.sections));
    request.radiosity = split_radiosity(options.radiosity, false);
    request.renders = options.renders;
    request.conditioning = options.conditioning;
    request.serial = options.serial;
    request.povray = options.povray;
    request.rules = options.rules;
    request.mpiexec = options.mpiexec;
    request.folder = make_folder(options.out);
    SeamsReport report;
    request.mpipov = shipped_file("mpipov");
    const Exit outcome = run_seams(request, report);
    fmt::print("{}", to_table(report));
    return outcome;
}

}  // namespace

Command add_seams_command(CLI::App& program) {
    auto options = std::make_shared<SeamsOptions>();
    CLI::App* app = program.add_subcommand(
        "seams",
        "Renders a scene serially and in sections, in every combination of what is listed, and "
        "says of each how far it is from the serial render: identical, within the scene's own "
        "noise, or not. All arguments that are not listed here are POV-Ray's.");
    pass_on_povray_arguments(*app);
    app->add_option("--out", options->out,
                    "where images, records and seams.json go; an earlier result there stays "
                    "until a first case has been rendered")
        ->type_name("DIR")
        ->required();
    const auto list = [&](const char* name, std::string& value, const std::string& text) {
        app->add_option(name, value, text)->type_name("LIST")->capture_default_str();
    };
    list("--ranks", options->ranks, "numbers of MPI ranks");
    list("--schedule", options->schedule, names_of(schedules));
    list("--shape", options->shape, names_of(shapes));
    list("--seams", options->seams, "aligned, halo:N, plain");
    list("--sections", options->sections, "numbers of sections; those that cannot be are left out");
    list("--radiosity", options->radiosity, "auto, independent, shared[:PASSES], joined[:PASSES]");
    app->add_option("--renders", options->renders,
                    "how many serial renders tell noise from damage, beside the reference")
        ->check(CLI::Range(fewest_noise_renders, 1000))
        ->capture_default_str();
    app->add_option("--serial", options->serial,
                    "take the serial renders from what noise --out left there, of the same scene "
                    "with all its files, arguments and POV-Ray, instead of making them")
        ->type_name("DIR");
    app->add_flag("--conditioning,!--no-conditioning", options->conditioning,
                  "where a case would be blamed, move the camera by next to nothing first: an "
                  "ill-conditioned scene is called that (see mpipov-validate stability); default: "
                  "on");
    app->add_option("--povray", options->povray, "which POV-Ray to run")->capture_default_str();
    app->add_option("--mpiexec", options->mpiexec, "which mpiexec to run")->capture_default_str();
    add_scene_rules(*app, options->rules);
    app->footer(
        "Exit code: 0 all is as promised or within noise, 1 something is not, 2 usage, 3 the scene "
        "or POV-Ray, 4 a file cannot be read or written, 5 interrupted.");
    return {app, [app, options] { return run(*app, *options); }};
}

}  // namespace mpipov
