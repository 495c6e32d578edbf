#include "compare_command.h"

#include "compare.h"
#include "compare_report.h"
#include "json_output.h"
#include "number_check.h"
#include "other_file.h"
#include "run_image.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>

namespace mpipov {
namespace {

struct CompareOptions {
    std::string a, b, run, json, map;
    double peak = 1;
    bool ssim = false, no_ssim = false;
};

// Asked for (--ssim or --map) it has to work; else its absence is told with its reason.
std::optional<Ssim> ssim_of(const Comparison& comparison, const CompareOptions& options) {
    if (options.no_ssim) return {};
    const bool wanted = options.ssim || !options.map.empty();
    if (comparison.identical() && !wanted) return ssim_of_identical();
    try {
        return compute_ssim({{comparison.a, comparison.b, options.map}}, comparison.peak).front();
    } catch (const Failure& failure) {
        if (wanted || failure.code() == Exit::interrupted) throw;
        return Ssim{{}, {}, failure.what()};
    }
}

void require_other_files(const CompareOptions& options) {
    const std::vector<std::filesystem::path> read{options.a, options.b, options.run};
    if (options.json != "-") require_other_file("--json", options.json, read);
    require_other_file("--map", options.map, read);
    require_other_file("--map", options.map, {options.json});
}

Exit run_compare(const CompareOptions& options) {
    require_other_files(options);
    CompareRequest request{options.a, options.b, {}, options.peak};
    if (!options.run.empty()) request.run = read_record(options.run);
    Comparison comparison = compare_images(request);
    if (request.run) require_record_of(*request.run, options.run, options.a, options.b);
    comparison.ssim = ssim_of(comparison, options);

    if (options.json != "-") fmt::print("{}", to_table(comparison));
    if (!options.json.empty()) write_json(options.json, to_json(comparison));
    if (!options.map.empty() && !comparison.ssim->value)
        throw Failure(Exit::file, fmt::format("cannot write '{}': there is no SSIM, {}",
                                              options.map, comparison.ssim->reason));
    return comparison.identical() ? Exit::ok : Exit::differ;
}

}  // namespace

Command add_compare_command(CLI::App& program) {
    auto options = std::make_shared<CompareOptions>();
    CLI::App* app = program.add_subcommand(
        "compare",
        "How far image B is from image A, and where. Stored values are compared: no "
        "gamma, alpha as in the file.");
    app->add_option("A", options->a, "the reference image: the serial render")->required();
    app->add_option("B", options->b, "the image to judge")->required();
    app->add_option("--run", options->run,
                    "the record of the run that made B: adds the errors by distance from the "
                    "nearest seam, by section and by seam. Its pixel_sha1 has to be that of A or B "
                    "(of a JPEG it cannot be checked)")
        ->type_name("FILE");
    app->add_option("--json", options->json, "write the results as JSON; - is standard output")
        ->type_name("FILE");
    app->add_option("--peak", options->peak,
                    "peak of PSNR and range of SSIM, where full scale is 1; for float images that "
                    "are not in [0, 1]")
        ->check(finite_number("finite number above 0", "NUMBER > 0",
                              [](double value) { return value > 0; }))
        ->capture_default_str();
    CLI::Option* ssim =
        app->add_flag("--ssim", options->ssim, "compute SSIM even of identical images");
    CLI::Option* no_ssim = app->add_flag("--no-ssim", options->no_ssim, "do not compute SSIM");
    CLI::Option* map = app->add_option("--map", options->map,
                                       "write the SSIM map, one channel, 1 where A and B agree")
                           ->type_name("IMAGE");
    no_ssim->excludes(ssim)->excludes(map);
    app->footer(
        "Exit code: 0 identical, 1 they differ, 2 usage, 4 a file cannot be read or "
        "written or the two cannot be compared, 5 interrupted.");
    return {app, [options] { return run_compare(*options); }};
}

}  // namespace mpipov
