// The options of `simulate` as CLI11 wants them told.
#include "number_check.h"
#include "render_options.h"
#include "simulate_options.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>

namespace mpipov {
namespace {

const CLI::Range whole(1, 1 << 20);

CLI::Validator at_least_nothing() {
    return finite_number("number from 0", "NUMBER >= 0", [](double value) { return value >= 0; });
}

CLI::Validator above_nothing() {
    return finite_number("number above 0", "NUMBER > 0", [](double value) { return value > 0; });
}

std::vector<std::string> schedule_names() {
    std::vector<std::string> names;
    for (const Policy policy : schedules) names.emplace_back(to_string(policy));
    return names;
}

void add_costs(CLI::App& app, SimulateOptions& options) {
    const std::string group = "Where tracing costs what, one of";
    app.add_option("--run", options.run,
                   "the record (run.json) of a real run: its sections' CPU seconds and its terms")
        ->type_name("FILE")
        ->group(group);
    app.add_option("--costs", options.costs, "a cost map, see below")
        ->type_name("FILE")
        ->group(group);
    app.add_option("--serial-seconds", options.serial_seconds,
                   "what POV-Ray alone takes with one thread; needs --size")
        ->check(above_nothing())
        ->type_name("S")
        ->group(group);
    app.add_option("--against", options.against,
                   "seconds of the serial render that the speed-up is against [what the costs and "
                   "terms say; with gathered radiosity that is too much]")
        ->check(above_nothing())
        ->type_name("S")
        ->group(group);
    app.add_option("--size", options.size, "of the image, with --serial-seconds")
        ->type_name("WxH")
        ->group(group);
    app.add_option("--map", options.map, "with --serial-seconds: uniform, or hill, a made-up scene")
        ->check(CLI::IsMember({"uniform", "hill"}))
        ->capture_default_str()
        ->group(group);
}

void add_ranks(CLI::App& app, SimulateOptions& options) {
    const std::string group = "Ranks";
    app.add_option("--ranks", options.ranks, "numbers of ranks [1,2,4,8,16]")
        ->type_name("LIST")
        ->group(group);
    app.add_option("--slots", options.slots, "cores of each rank")
        ->check(whole)
        ->capture_default_str()
        ->group(group);
    app.add_option("--speeds", options.speeds,
                   "of the ranks' cores, in turn: 1,1,0.5 makes every third one half as fast")
        ->type_name("LIST")
        ->capture_default_str()
        ->group(group);
    app.add_option("--ranks-per-host", options.ranks_per_host,
                   "puts so many on each host, and with that the network between them on; 0: all "
                   "on one host")
        ->check(CLI::Range(0, 1 << 20))
        ->capture_default_str()
        ->group(group);
    app.add_flag("--dedicated-coordinator", options.dedicated, "rank 0 renders nothing")
        ->group(group);
}

void add_grid(CLI::App& app, SimulateOptions& options) {
    const std::string group = "As for mpipov";
    app.add_option("--schedule", options.schedule, "static, dynamic or cost")
        ->check(CLI::IsMember(schedule_names()))
        ->capture_default_str()
        ->group(group);
    app.add_option("--sections", options.sections,
                   "how many [the number that ends first; where the record's scene depends on the "
                   "order of rendering, the record's]")
        ->check(whole)
        ->group(group);
    app.add_option("--shape", options.shape, "auto, columns, rows or tiles")
        ->check(CLI::IsMember({"auto", "columns", "rows", "tiles"}))
        ->capture_default_str()
        ->group(group);
    app.add_option("--seams", options.seams, "aligned or plain [the record's, else aligned]")
        ->check(CLI::IsMember({"aligned", "plain"}))
        ->group(group);
    app.add_option("--in-flight", options.in_flight,
                   "launches under way on a rank [the number that ends first]")
        ->check(whole)
        ->group(group);
    app.add_option("--threads", options.threads, "of a launch [the record's, else 1]")
        ->check(whole)
        ->group(group);
}

void add_terms(CLI::App& app, SimulateOptions& options) {
    const std::string group = "Terms, in seconds where nothing else is said";
    const auto add = [&](const char* flag, const char* name, const char* what) {
        app.add_option_function<double>(
               flag, [&options, name](const double& value) { options.values[name] = value; }, what)
            ->check(at_least_nothing())
            ->type_name("S")
            ->group(group);
    };
    add("--start-up", term::start, "of a launch's start, its core idle");
    add("--end", term::end, "of a launch's end, its core idle");
    add("--bare", term::bare, "CPU of a launch of an empty scene");
    add("--parse", term::parse, "CPU to parse the scene, each launch");
    add("--photons", term::photons, "CPU to shoot photons, each launch");
    add("--pretrace", term::radiosity, "CPU of radiosity's pretrace, each launch");
    add("--frame", term::frame, "CPU to write the frame, each launch [70 ns a pixel of the image]");
    add("--answer", term::answer, "from a launch's end until rank 0's answer is there");
    add("--before", term::before, "before the first section: start of MPI, probe");
    add("--after", term::after, "after the last section: the image file");
    add("--latency", term::latency, "of a message between hosts");
    app.add_option_function<double>(
           "--bandwidth",
           [&options](const double& value) { options.values[term::bandwidth] = value; },
           "bytes a second into rank 0's host")
        ->check(above_nothing())
        ->type_name("B")
        ->group(group);
    app.add_option("--coordinator-rate", options.coordinator_rate,
                   "sections a second that rank 0 can handle at most [measured, "
                   "docs/simulation.md]")
        ->check(above_nothing())
        ->type_name("N")
        ->group(group);
    app.add_option("--without", options.without, "switches a term off; may be given again")
        ->type_name("TERM")
        ->group(group);
}

void add_output(CLI::App& app, SimulateOptions& options) {
    app.add_option("--bar", options.bars,
                   "RANKS:EFFICIENCY that is wanted, like 64:0.95; may be given again")
        ->type_name("N:E");
    app.add_option("--json", options.json, "write the results as JSON; - is standard output")
        ->type_name("FILE");
    CLI::Option* paper = app.add_flag(
        "--paper", options.paper,
        "MPIPOV1 and 2 as they were, and mpipov's protocol on the same machine; of the options "
        "above only costs, --ranks and --bandwidth count");
    app.add_option("--paper-latency", options.paper_latency,
                   "milliseconds of a message [so that MPIPOV2 on 2 ranks is as in the paper]")
        ->check(at_least_nothing())
        ->type_name("MS")
        ->needs(paper);
    app.add_option("--strips", options.strips, "MPIPOV2's G [n + 1, n being the ranks that render]")
        ->check(whole)
        ->type_name("G")
        ->needs(paper);
}

}  // namespace

void add_simulate_options(CLI::App& app, SimulateOptions& options) {
    add_costs(app, options);
    add_ranks(app, options);
    add_grid(app, options);
    add_terms(app, options);
    add_output(app, options);
}

}  // namespace mpipov
