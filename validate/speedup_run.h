// Measures how long a scene takes in each way to render it, all ways in turns.
#pragma once

#include "failure.h"
#include "speedup_report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mpipov {

struct SpeedupRequest {
    std::vector<std::string> arguments;  // scene and POV-Ray's own
    std::filesystem::path folder;        // for speedup.json and the records of mpipov
    SpeedupChoice choice;
    int repeat = 3;
    SpeedupTools tools;
};

// Writes speedup.json into the folder after every run, whatever fails. Exit::ok; Exit::differ where
// an image of mpipov is not the serial one though the scene does not depend on the order of
// rendering; of a variant that failed usage, scene or file. Throws Failure for what stops all, once
// that is written too: POV-Ray cannot render the scene serially, a file, interrupted.
Exit run_speedup(const SpeedupRequest& request, SpeedupReport& report);

}  // namespace mpipov
