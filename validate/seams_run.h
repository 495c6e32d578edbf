// Renders a scene serially and in sections, in all the ways asked for, and judges the difference.
#pragma once

#include "failure.h"
#include "schedule.h"
#include "seams_report.h"
#include "section.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mpipov {

struct SeamKind {
    Seams seams = Seams::aligned;
    int halo = 0;
    bool operator==(const SeamKind&) const = default;
    std::string text() const;  // as --seams of mpipov takes it
    std::string name() const;  // without a colon
};

struct SeamsRequest {
    std::vector<std::string> arguments;  // scene and POV-Ray's own
    std::filesystem::path folder;
    std::vector<Policy> schedules{Policy::dynamic};
    std::vector<int> ranks{1, 2};
    std::vector<Shape> shapes{Shape::columns};
    std::vector<SeamKind> seams;
    std::vector<int> sections{2, 8, 32};
    std::vector<std::string> radiosity{"auto"};  // as --radiosity of mpipov takes it
    int renders = default_noise_renders;
    bool conditioning = true;      // measured where something would be blamed
    std::filesystem::path serial;  // of `noise --out`; empty: serial renders are made
    std::string povray = "povray", mpiexec = "mpiexec";
    std::filesystem::path mpipov;  // the program
    SceneRules rules = {};
};

// Writes seams.json into the folder after every case, whatever fails. Exit::ok or Exit::differ; of
// a failed case what mpipov exited with. Throws Failure for what stops all cases, once that is
// written too.
Exit run_seams(const SeamsRequest& request, SeamsReport& report);

}  // namespace mpipov
