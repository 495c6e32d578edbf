#include "speedup_command.h"

#include "render_options.h"
#include "shipped_file.h"
#include "speedup_run.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

namespace mpipov {
namespace {

struct SpeedupOptions {
    std::string out = "speedup", ranks = "1,2", schedule = "static,dynamic", slots = "1",
                povray = "povray", mpiexec = "mpiexec";
    int repeat = 3;
    bool dedicated = false;
    SceneRules rules;
};

SpeedupChoice choice_of(const SpeedupOptions& options) {
    SpeedupChoice choice;
    choice.ranks = each_once(split_numbers("--ranks", options.ranks));
    std::sort(choice.ranks.begin(), choice.ranks.end());
    choice.schedules = each_once(split_names("--schedule", options.schedule, schedules));
    choice.dedicated = options.dedicated;
    return choice;
}

Exit run(const CLI::App& app, const SpeedupOptions& options) {
    SpeedupRequest request;
    request.arguments = povray_arguments(app);
    request.choice = choice_of(options);
    request.repeat = options.repeat;
    if (options.slots != "auto" && split_numbers("--slots", options.slots).size() != 1)
        throw Failure(
            Exit::usage,
            fmt::format("--slots: '{}' is neither auto nor a whole number from 1", options.slots));
    request.tools = {options.povray,
                     options.mpiexec,
                     options.slots,
                     shipped_file("mpipov"),
                     shipped_file(std::filesystem::path(MPIPOV_SHARE_FROM_BIN) / "bands.sh"),
                     options.rules};
    request.folder = make_folder(options.out);
    SpeedupReport report;
    try {
        const Exit outcome = run_speedup(request, report);
        fmt::print("{}", to_table(report));
        return outcome;
    } catch (const Failure&) {
        if (!report.repetitions.empty()) fmt::print("{}", to_table(report));
        throw;
    }
}

}  // namespace

Command add_speedup_command(CLI::App& program) {
    auto options = std::make_shared<SpeedupOptions>();
    CLI::App* app = program.add_subcommand(
        "speedup",
        "Measures the wall time of a scene rendered by POV-Ray serially (+WT1), by POV-Ray's own "
        "threads (+WTn), in n equal bands from a shell script (xargs, oiiotool), and by mpipov on "
        "n ranks: all in turns, in another order each time. Prints time and speed-up against "
        "serial, a column for each n, and writes speedup.json with all raw times. All arguments "
        "that are not listed here are POV-Ray's.");
    pass_on_povray_arguments(*app);
    app->add_option("--ranks", options->ranks, "numbers n of processors")
        ->type_name("LIST")
        ->capture_default_str();
    app->add_option("--repeat", options->repeat, "how often each is run")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    app->add_option("--schedule", options->schedule, "of mpipov: " + names_of(schedules))
        ->type_name("LIST")
        ->capture_default_str();
    app->add_flag("--dedicated", options->dedicated,
                  "measure mpipov with --dedicated-coordinator too, where n > 1");
    app->add_option("--slots", options->slots,
                    "cores that each rank may use, as for mpipov; 1, so that n ranks are n "
                    "processors. auto: its share of the host")
        ->type_name("N")
        ->capture_default_str();
    app->add_option("--out", options->out,
                    "where speedup.json and mpipov's records go; an earlier result there stays "
                    "until the scene has been rendered once")
        ->type_name("DIR")
        ->capture_default_str();
    app->add_option("--povray", options->povray, "which POV-Ray to run")->capture_default_str();
    app->add_option("--mpiexec", options->mpiexec, "which mpiexec to run")->capture_default_str();
    add_scene_rules(*app, options->rules);
    app->footer(
        "speedup.json is written after every run: what was measured before an interruption stays, "
        "and \"complete\" says whether all was. A way to render that fails is told in its row and "
        "not tried again. Every image is compared with the serial one.\n\n"
        "Exit code: 0 measured, whatever the times; 1 an image of mpipov is not the serial one "
        "though the scene does not depend on the order of rendering; 2 usage, 3 the scene or "
        "POV-Ray, 4 a file cannot be read or written, 5 interrupted. Where only some ways to "
        "render fail, the code is that of the first.");
    return {app, [app, options] { return run(*app, *options); }};
}

}  // namespace mpipov
