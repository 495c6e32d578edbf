#include "tradeoff_renders.h"

#include "failure.h"
#include "povray_command.h"
#include "run_child.h"
#include "run_image.h"
#include "worker.h"

#include <fmt/format.h>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

void append(std::vector<std::string>& argv, const std::vector<std::string>& more) {
    argv.insert(argv.end(), more.begin(), more.end());
}

std::vector<std::string> arguments_of(const TradeoffSetting& setting) {
    std::vector<std::string> arguments = setting.arguments;
    append(arguments, measured_format);
    return arguments;
}

}  // namespace

TradeoffRenderer::TradeoffRenderer(TradeoffTools tools, std::vector<std::string> user_arguments,
                                   fs::path scratch)
    : tools_(std::move(tools)),
      arguments_(std::move(user_arguments)),
      scratch_(std::move(scratch)),
      serial_(tools_.povray, arguments_, scratch_, tools_.rules) {}

std::vector<std::string> TradeoffRenderer::argv(const TradeoffSetting& setting) const {
    if (!setting.mpipov) {
        std::vector<std::string> argv{tools_.povray};
        append(argv, quote_arguments(arguments_));
        append(argv, arguments_of(setting));
        argv.emplace_back("+WT1");
        return argv;
    }
    std::vector<std::string> argv{tools_.mpiexec, "-n", fmt::format("{}", setting.ranks),
                                  tools_.mpipov.string()};
    append(argv, setting.options);
    append(argv, {"--povray", tools_.povray, "--progress", "none"});
    append(argv, tools_.rules.given);
    append(argv, arguments_);
    append(argv, arguments_of(setting));
    return argv;
}

std::vector<std::string> TradeoffRenderer::user_argv(const TradeoffSetting& setting) const {
    std::vector<std::string> argv;
    if (setting.mpipov) {
        argv = {tools_.mpiexec, "-n", fmt::format("{}", setting.ranks), "mpipov"};
        append(argv, setting.options);
        if (tools_.povray != "povray") append(argv, {"--povray", tools_.povray});
        append(argv, tools_.rules.given);
        append(argv, arguments_);
    } else {
        argv = {tools_.povray};
        append(argv, quote_arguments(arguments_));
    }
    append(argv, setting.arguments);
    if (!setting.mpipov) argv.emplace_back("+WT1");
    return argv;
}

TradeoffRun TradeoffRenderer::run(const TradeoffSetting& setting) const {
    return setting.mpipov ? run_mpipov(setting) : run_serial(setting);
}

TradeoffRun TradeoffRenderer::run_serial(const TradeoffSetting& setting) const {
    const SerialRender render =
        serial_.render(setting.name, arguments_of(setting), scratch_ / "images");
    return {render.image, render.wall_seconds, render.cpu_seconds, 0};
}

TradeoffRun TradeoffRenderer::run_mpipov(const TradeoffSetting& setting) const {
    const fs::path place = scratch_ / "mpipov";
    std::error_code error;
    fs::remove_all(place, error);
    if (!fs::create_directories(place, error))
        throw Failure(Exit::file,
                      fmt::format("cannot make '{}': {}", place.string(), error.message()));
    const fs::path record = place / "run.json";
    ChildRequest child;
    child.argv = argv(setting);
    append(child.argv,
           {"--record", record.string(), fmt::format("+O{}", (place / "image").string())});
    std::string output;
    const ChildResult result = run_child(child, &output);
    if (result.exit_code != 0) throw mpipov_failure(result, output, tools_.mpiexec);
    const RunRecord run = read_record(record);
    return {run.output, result.wall_seconds,
            run.totals.cpu_seconds + run.totals.coordinator_cpu_seconds, run.plan.sections};
}

}  // namespace mpipov
