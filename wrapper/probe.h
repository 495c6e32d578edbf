// Asks POV-Ray about a scene: what the result is, and what it costs. Five short launches side by
// side:
//  1. the user's own command with a header file that stops the parser at once: POV-Ray has then
//     printed its version, size, region, output file and type as it resolved them, and touched
//     nothing;
//  2. the whole picture, small: which effects are on, and their times; its file is the sample that
//     the result's metadata is taken from;
//  3. to 5. the same without antialiasing, in three orders and sizes of blocks (+RP, +BS): whether
//     the pixels depend on it. One other is not enough: where only a few blocks use random numbers,
//     many orders leave those as they were.
// A scene that cannot be rendered small is asked again with the middle of its picture in full size.
#pragma once

#include "confinement.h"
#include "probe_result.h"
#include "stitch.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mpipov {

struct ProbeRequest {
    std::string povray = "povray";
    std::vector<std::string> user_arguments;  // quoted as POV-Ray wants them
    std::filesystem::path scratch;            // an empty folder
    std::optional<double> timeout_seconds;    // of a launch; see small_timeout()
    // Called once where radiosity shows, well before the probe is over: the pixels depend on the
    // order of rendering then.
    std::function<void()> at_radiosity = {};
    Confinement confinement = {};
};

struct Probe {
    std::string povray;  // its version
    ProbeResult result;
    FileStyle style;
    IniSettings settings;         // of the user's own command, with our +HI and +GI
    std::string radiosity_cache;  // samples of a small render of the whole picture; may be empty
    std::vector<std::string> warnings;
    double cpu_seconds = 0;
    int launches = 0;
};

// Throws Failure: usage where POV-Ray refuses an option or nothing can be made of the result (no
// output file, standard output, an animation, an empty region, an unknown type), scene where it
// refuses the scene, there is no POV-Ray or it is no POV-Ray 3.7; interrupted.
Probe run_probe(const ProbeRequest& request);

// Of the `povray` on the PATH or the one named. Throws Failure(Exit::scene) where there is none or
// it is no POV-Ray 3.7.
std::string povray_version(const std::string& povray);

}  // namespace mpipov
