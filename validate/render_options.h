// What the subcommands that render have in common: a scene with POV-Ray's own arguments, and how to
// tell those from ours.
#pragma once

#include "failure.h"

#include <CLI/App.hpp>

#include <algorithm>
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
// What is listed twice counts once, where it stands first.
template <class T>
std::vector<T> each_once(const std::vector<T>& values) {
    std::vector<T> once;
    for (const T& value : values)
        if (std::find(once.begin(), once.end(), value) == once.end()) once.push_back(value);
    return once;
}
// Whole numbers from 1.
std::vector<int> split_numbers(const std::string& option, const std::string& text);

// The folder's own path, made where it is not there. Throws Failure(Exit::file).
std::filesystem::path make_folder(const std::filesystem::path& folder);

}  // namespace mpipov
