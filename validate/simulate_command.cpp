#include "simulate_command.h"

#include "json_output.h"
#include "simulate_options.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <stdexcept>

namespace mpipov {
namespace {

template <class Report>
void write(const Report& report, const SimulateOptions& options) {
    if (options.json != "-") fmt::print("{}", to_table(report));
    if (!options.json.empty()) write_json(options.json, to_json(report));
}

Exit run_paper(const SimulateOptions& options) {
    const SimulateCase what = simulate_case(options);
    PaperMachine machine;
    if (const auto given = options.values.find(term::bandwidth); given != options.values.end())
        machine.bytes_per_second = given->second;
    machine.latency = options.paper_latency.value_or(0) / 1e3;
    PaperReport report = simulate_paper(what.costs, machine, options.strips, !options.paper_latency,
                                        simulate_ranks(options));
    report.costs_from = what.costs_from;
    write(report, options);
    return Exit::ok;
}

Exit run(const SimulateOptions& options) {
    try {
        if (options.paper) return run_paper(options);
        SimulateReport report;
        report.what = simulate_case(options);
        report.bars = simulate_bars(options);
        for (const int ranks : simulate_ranks(options))
            report.rows.push_back(simulate(report.what, ranks));
        write(report, options);
        return std::ranges::all_of(report.bars,
                                   [&](const SimulateBar& bar) { return report.met(bar); })
                   ? Exit::ok
                   : Exit::differ;
    } catch (const std::invalid_argument& error) {
        throw Failure(Exit::usage, error.what());
    }
}

}  // namespace

Command add_simulate_command(CLI::App& program) {
    auto options = std::make_shared<SimulateOptions>();
    CLI::App* app = program.add_subcommand(
        "simulate",
        "What a render would take on ranks that are not there: the scheduler that MPI drives, on a "
        "virtual clock. Says of each number of ranks which term is in the way and how efficient it "
        "would be without it. --paper: MPIPOV1 and MPIPOV2 of 1999 instead.");
    add_simulate_options(*app, *options);
    app->footer(
        "A cost map is JSON: {\"format\": \"mpipov-costs\", \"version\": 1, \"width\": W, "
        "\"height\": H, \"rectangles\": [{\"x0\": 0, \"y0\": 0, \"x1\": 32, \"y1\": 32, "
        "\"cpu_seconds\": 1.5}, ...]}, in pixels from the top left, x1 and y1 not included; "
        "rectangles do not overlap, and what none covers costs nothing.\n\n"
        "Exit code: 0 simulated, and every --bar met; 1 a --bar is missed, 2 usage, 4 a file "
        "cannot be read or written.");
    return {app, [options] { return run(*options); }};
}

}  // namespace mpipov
