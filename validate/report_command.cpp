#include "report_command.h"

#include "json_output.h"
#include "other_file.h"
#include "python_script.h"
#include "report_input.h"
#include "scratch.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

struct ReportOptions {
    std::string folder, output;
};

Exit run_report(const ReportOptions& options) {
    std::error_code error;
    const fs::path root = fs::canonical(options.folder, error);
    if (error)
        throw Failure(Exit::file,
                      fmt::format("cannot read '{}': {}", options.folder, error.message()));
    if (!fs::is_directory(root))
        throw Failure(Exit::file, fmt::format("'{}' is no folder: name the one that was given to "
                                              "mpipov-validate seams --out, or one above it",
                                              options.folder));
    const nlohmann::json input = collect_results(root);
    if (input.at("entries").empty())
        throw Failure(
            Exit::file,
            fmt::format("there is no seams.json, speedup.json, noise.json, tradeoff.json or "
                        "stability.json below '{}': "
                        "make one with mpipov-validate seams",
                        options.folder));
    const fs::path page = options.output.empty() ? root / "report.html" : fs::path(options.output);
    for (const auto& entry : input.at("entries"))
        require_other_file("--output", page, {root / entry.at("file").get<std::string>()});
    const ScratchFolder scratch("report");
    const std::string input_file = (scratch.path() / "input.json").string();
    write_json(input_file, input);
    run_script("report.py", {input_file, "--output", page.string()});
    const std::string shown = options.output.empty()
                                  ? (fs::path(options.folder) / "report.html").string()
                                  : options.output;
    fmt::print("{}\n", shown);
    return Exit::ok;
}

}  // namespace

Command add_report_command(CLI::App& program) {
    auto options = std::make_shared<ReportOptions>();
    CLI::App* app = program.add_subcommand(
        "report",
        "One self-contained HTML page out of all results (seams.json, speedup.json, noise.json, "
        "tradeoff.json, stability.json) below a folder, failures first.");
    app->add_option("DIR", options->folder, "the folder to search")->required();
    app->add_option("--output", options->output, "the page's file (default: DIR/report.html)")
        ->type_name("FILE");
    app->footer(
        "Exit code: 0 the page was written, whatever it tells; 2 usage, 4 there are no results or "
        "a file cannot be read or written, 5 interrupted.");
    return {app, [options] { return run_report(*options); }};
}

}  // namespace mpipov
