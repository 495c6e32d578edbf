#include "tradeoff_command.h"

#include "python_script.h"
#include "render_options.h"
#include "shipped_file.h"
#include "tradeoff_run.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <functional>
#include <memory>

namespace mpipov {
namespace {

struct TradeoffOptions {
    std::string out = "tradeoff", sweep = "auto", methods = "1,2", depths = "1,2,3,4,5",
                thresholds = "0.3,0.1,0.03,0.01", sections = "2,4,8,16,32,64", halos = "1,2,4,8",
                threads = "1,2",
                radiosity =
                    "independent,shared:1,shared:2,shared:3,joined:1,joined:2,shared:1/2,"
                    "shared:1/4,joined:1/2",
                average = "linear", povray = "povray", mpiexec = "mpiexec";
    int ranks = 2, repeat = 3, truth_samples = 13448;
    double truth_seconds = 600;
    std::optional<double> max_error, max_seconds;
    SceneRules rules;
};

std::vector<int> sorted_numbers(const std::string& option, const std::string& text, int most) {
    std::vector<int> numbers = each_once(split_numbers(option, text));
    std::sort(numbers.begin(), numbers.end());
    if (numbers.back() > most)
        throw Failure(Exit::usage,
                      fmt::format("{}: {} is more than {}", option, numbers.back(), most));
    return numbers;
}

// The lowest last: the most accurate.
std::vector<double> thresholds_of(const std::string& text) {
    std::vector<double> thresholds;
    for (const std::string& piece : split_list("--thresholds", text)) {
        double value = 0;
        const char* end = piece.data() + piece.size();
        const auto parsed = std::from_chars(piece.data(), end, value);
        if (parsed.ec != std::errc() || parsed.ptr != end || !(value >= 0 && value <= 3))
            throw Failure(Exit::usage,
                          fmt::format("--thresholds: '{}' is no number from 0 to 3", piece));
        thresholds.push_back(value);
    }
    thresholds = each_once(thresholds);
    std::sort(thresholds.begin(), thresholds.end(), std::greater<>());
    return thresholds;
}

TradeoffChoice choice_of(const TradeoffOptions& options) {
    constexpr int most = 100000, deepest = 9;
    TradeoffChoice choice;
    if (options.sweep != "auto")
        choice.sweeps = each_once(split_names("--sweep", options.sweep, sweeps));
    choice.methods = sorted_numbers("--methods", options.methods, 2);
    choice.depths = sorted_numbers("--depths", options.depths, deepest);
    choice.thresholds = thresholds_of(options.thresholds);
    choice.sections = sorted_numbers("--sections", options.sections, most);
    choice.halos = sorted_numbers("--halos", options.halos, most);
    choice.threads = sorted_numbers("--threads", options.threads, most);
    choice.radiosity = split_radiosity(options.radiosity, true);
    choice.ranks = options.ranks;
    return choice;
}

Exit run(const CLI::App& app, const TradeoffOptions& options) {
    TradeoffRequest request;
    request.arguments = povray_arguments(app);
    request.choice = choice_of(options);
    request.repeat = options.repeat;
    request.averaging = options.average == "linear" ? Averaging::linear : Averaging::encoded;
    request.most_samples = options.truth_samples;
    request.truth_seconds = options.truth_seconds;
    request.max_error = options.max_error;
    request.max_seconds = options.max_seconds;
    request.povray = options.povray;
    request.rules = options.rules;
    request.mpiexec = options.mpiexec;
    request.mpipov = shipped_file("mpipov");
    request.folder = make_folder(options.out);
    TradeoffReport report;
    Exit outcome = Exit::ok;
    try {
        outcome = run_tradeoff(request, report);
    } catch (const Failure&) {
        const auto measured = [](const TradeoffRow& row) { return row.measured(); };
        if (std::any_of(report.rows.begin(), report.rows.end(), measured))
            fmt::print("{}", to_table(report));
        throw;
    }
    fmt::print("{}", to_table(report));
    run_script("tradeoff_pictures.py", {(request.folder / "tradeoff.json").string()});
    return outcome;
}

void add_lists(CLI::App& app, TradeoffOptions& options) {
    const auto list = [&](const char* name, std::string& value, const std::string& text) {
        app.add_option(name, value, text)->type_name("LIST")->capture_default_str();
    };
    list("--sweep", options.sweep,
         "what is varied: " + names_of(sweeps) + "; auto: what the scene calls for");
    list("--methods", options.methods, "of antialiasing: 1, 2");
    list("--depths", options.depths, "of antialiasing: 1 to 9");
    list("--thresholds", options.thresholds, "of antialiasing");
    list("--sections", options.sections, "numbers of sections; those that cannot be are left out");
    list("--halos", options.halos, "of --seams halo:N");
    list("--radiosity", options.radiosity,
         "of mpipov's --radiosity; /N behind one: with --radiosity-scale N");
    list("--threads", options.threads, "of one launch, one rank");
}

}  // namespace

Command add_tradeoff_command(CLI::App& program) {
    auto options = std::make_shared<TradeoffOptions>();
    CLI::App* app = program.add_subcommand(
        "tradeoff",
        "What accuracy costs: renders a scene with other antialiasing, in other sections, with "
        "radiosity shared in other ways and with more threads, one thing changed at a time, and "
        "measures time and error of each, the error against a render with many samples a pixel. "
        "Prints a table and what halving the error costs, and writes tradeoff.json, tradeoff.png "
        "and crops.png. All arguments that are not listed here are POV-Ray's.");
    pass_on_povray_arguments(*app);
    add_lists(*app, *options);
    app->add_option("--ranks", options->ranks, "of mpipov, where it renders sections")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    app->add_option("--repeat", options->repeat, "how often each is run")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    app->add_option("--max-error", options->max_error,
                    "print the command of the setting that takes the least wall time and is not "
                    "farther than this from the truth, in levels of 255")
        ->type_name("E")
        ->check(CLI::NonNegativeNumber);
    app->add_option("--max-seconds", options->max_seconds,
                    "print the command of the most accurate setting that takes no more wall time")
        ->type_name("S")
        ->check(CLI::NonNegativeNumber);
    app->add_option("--truth-samples", options->truth_samples,
                    "samples a pixel of the truth, at most; from 164 on there are as many as make "
                    "its own error a tenth of the best setting's")
        ->check(CLI::Range(truth_samples(1), truth_samples(deepest_truth)))
        ->capture_default_str();
    app->add_option("--truth-seconds", options->truth_seconds,
                    "no truth that must be expected to take longer is tried")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app->add_option("--average", options->average,
                    "how the truth's samples are averaged: in linear light, or encoded, as POV-Ray "
                    "itself does where a scene has no assumed_gamma 1")
        ->check(CLI::IsMember({"linear", "encoded"}))
        ->capture_default_str();
    app->add_option("--out", options->out,
                    "where tradeoff.json and all images go; what an earlier call measured there of "
                    "the same scene, arguments, programs and machine is gone on from")
        ->type_name("DIR")
        ->capture_default_str();
    app->add_option("--povray", options->povray, "which POV-Ray to run")->capture_default_str();
    app->add_option("--mpiexec", options->mpiexec, "which mpiexec to run")->capture_default_str();
    add_scene_rules(*app, options->rules);
    app->footer(
        "The antialiasing is swept by serial renders, the rest at the scene's own antialiasing, or "
        "+A0.3 where it has none. tradeoff.json is written after every render: the same command "
        "goes on from it after an interruption.\n\n"
        "Exit code: 0 measured; 1 no setting is within --max-error or --max-seconds; 2 usage, 3 "
        "the scene or POV-Ray, 4 a file cannot be read or written, 5 interrupted. Where only some "
        "settings fail, the code is that of the first.");
    return {app, [app, options] { return run(*app, *options); }};
}

}  // namespace mpipov
