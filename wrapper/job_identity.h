// What makes two runs the same job, so that one may go on from what the other finished: the same
// POV-Ray, the same settings as POV-Ray itself resolved them, the same size and region, the same
// command line, and the same bytes in every file that the scene is made of, as far as its text
// names them (scene_files.h says what cannot be found).
#pragma once

#include "probe.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace mpipov {

// Reads the scene's files. `arguments` are POV-Ray's. Throws nothing but std::bad_alloc.
nlohmann::json job_identity(const Probe& probe, const std::vector<std::string>& arguments,
                            const std::string& povray_version);

// Of the scene's files alone: the same for any size and options. 40 hexadecimal digits.
std::string scene_sha1(const nlohmann::json& identity);

// The files themselves.
std::vector<std::filesystem::path> files_of_scene(const nlohmann::json& identity);

// The first thing in which two of them differ, with both values where they can be told: "Width
// changed from 320 to 640", "'colours.inc' changed"; "" where they are the same. Any members are
// compared, not only ours.
std::string what_changed(const nlohmann::json& earlier, const nlohmann::json& now);

}  // namespace mpipov
