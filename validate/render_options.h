// What `noise` and `seams` have in common: a scene with POV-Ray's own arguments, and how to tell
// those from ours.
#pragma once

#include "failure.h"
#include "seams_report.h"

#include <CLI/App.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace mpipov {

// Everything that is none of `app`'s options, in order: the scene and POV-Ray's arguments. Call
// before parsing.
void pass_on_povray_arguments(CLI::App& app);

// Those arguments, after parsing. Throws Failure(Exit::usage) where there are none, or one begins
// with "--".
std::vector<std::string> povray_arguments(const CLI::App& app);

// "1,2,4" -> the pieces. Throws Failure(Exit::usage), naming the option, where one is empty.
std::vector<std::string> split_list(const std::string& option, const std::string& text);
// Whole numbers from 1.
std::vector<int> split_numbers(const std::string& option, const std::string& text);

// What is known of the scene before anything of it is rendered as a whole.
struct SceneAsked {
    std::string povray_version;
    std::string name, file;  // file: as the user gave it
    bool order_dependent = false;
    int longest_side = 0;
};
// Throws Failure as run_probe does.
SceneAsked ask_scene(const std::string& povray, const std::vector<std::string>& arguments,
                     const std::filesystem::path& scratch);

// The folder's own path, made where it is not there. Throws Failure(Exit::file).
std::filesystem::path make_folder(const std::filesystem::path& folder);

inline constexpr int fewest_noise_renders = 3, default_noise_renders = 12;

// Renders, compares with the reference (with the record's seams where there is one) and measures.
struct NoiseSource {
    const SerialRenderer& renderer;
    const SerialRender& reference;
    int wanted = default_noise_renders;
    bool order_dependent = false;
    std::filesystem::path folder;
};
NoiseReport find_noise(const NoiseSource& source);
void compare_noise(NoiseReport& noise, const SerialRender& reference,
                   const std::optional<RunRecord>& run);

}  // namespace mpipov
