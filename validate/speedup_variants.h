// What is measured against what: the ways to render one scene with n processors. Pure.
#pragma once

#include "scene_rules.h"
#include "schedule.h"
#include "section.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mpipov {

struct SpeedupVariant {
    // serial: one POV-Ray with one thread, what every speed-up is against. threads: one POV-Ray
    // with n of its own threads; with n = 1 that is the serial command again, and shows how far two
    // measurements of the same lie apart. bands: n POV-Rays on equal bands of rows, from a shell
    // script. mpipov: n ranks.
    enum class Kind { serial, threads, bands, mpipov };
    Kind kind = Kind::serial;
    int ranks = 1;           // n
    std::string schedule;    // of mpipov
    bool dedicated = false;  // rank 0 of mpipov renders nothing

    std::string what() const;  // for people, the same for all n: a line of a table
    std::string name() const;  // of a file, too
};

struct SpeedupChoice {
    std::vector<int> ranks;  // in the order of the columns
    std::vector<Policy> schedules;
    bool dedicated = false;  // measures mpipov both ways where there is more than one rank
};

// The serial one first, then line by line, each for all n.
std::vector<SpeedupVariant> speedup_variants(const SpeedupChoice& choice);

// The scene as POV-Ray resolved it.
struct SpeedupScene {
    std::vector<std::string> arguments;  // the scene and POV-Ray's own, as the user gave them
    int width = 0;                       // of the whole image, pixels
    Rect region;                         // what of it is rendered
    std::string extension;               // of the image file, with its dot
};

struct SpeedupTools {
    std::string povray = "povray", mpiexec = "mpiexec", slots = "1";
    std::filesystem::path mpipov, bands;  // programs of ours
    SceneRules rules = {};
};

// The whole argv. The image becomes `folder`/image + extension; the record of mpipov `record`.
std::vector<std::string> speedup_command(const SpeedupVariant& variant, const SpeedupTools& tools,
                                         const SpeedupScene& scene,
                                         const std::filesystem::path& folder,
                                         const std::filesystem::path& record);

}  // namespace mpipov
