// Measures what accuracy costs: each setting's time and error, all settings in turns.
#pragma once

#include "failure.h"
#include "scene_rules.h"
#include "tradeoff_report.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mpipov {

struct TradeoffRequest {
    std::vector<std::string> arguments;  // scene and POV-Ray's own
    std::filesystem::path folder;        // for tradeoff.json and the images
    TradeoffChoice choice;
    int repeat = 3;
    Averaging averaging = Averaging::linear;
    int most_samples = 13448;           // of a pixel of the truth
    double truth_seconds = 600;         // that one more truth may be expected to take
    std::optional<double> max_error;    // levels of 255
    std::optional<double> max_seconds;  // wall
    std::string povray = "povray", mpiexec = "mpiexec";
    std::filesystem::path mpipov;
    SceneRules rules = {};
};

// Writes tradeoff.json into the folder after every render, whatever fails; goes on from what an
// earlier call left there of the same scene, arguments, POV-Ray and machine. Exit::ok;
// Exit::differ where no setting fits --max-error or --max-seconds; of a setting that failed usage,
// scene or file. Throws Failure for what stops all: POV-Ray cannot render the scene serially, a
// file, interrupted.
Exit run_tradeoff(const TradeoffRequest& request, TradeoffReport& report);

}  // namespace mpipov
