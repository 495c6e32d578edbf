// What the subcommands that render have in common: a scene with POV-Ray's own arguments, and how to
// tell those from ours.
#pragma once

#include "failure.h"
#include "schedule.h"

#include <CLI/App.hpp>
#include <fmt/format.h>

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

// "columns, rows, tiles".
template <class Enum>
std::string names_of(const std::vector<Enum>& values) {
    std::string text;
    for (const Enum& value : values)
        text += fmt::format("{}{}", text.empty() ? "" : ", ", to_string(value));
    return text;
}

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
// A list of names, each that of one of `known` by to_string. Throws as split_list.
template <class Enum>
std::vector<Enum> split_names(const std::string& option, const std::string& text,
                              const std::vector<Enum>& known) {
    std::vector<Enum> values;
    for (const std::string& piece : split_list(option, text)) {
        const auto named = [&](const Enum& one) { return to_string(one) == piece; };
        const auto found = std::find_if(known.begin(), known.end(), named);
        if (found == known.end())
            throw Failure(Exit::usage,
                          fmt::format("{}: '{}' is not one of {}", option, piece, names_of(known)));
        values.push_back(*found);
    }
    return values;
}

// All that mpipov's --schedule takes.
inline const std::vector<Policy> schedules{Policy::static_, Policy::dynamic, Policy::cost};

// A list of what mpipov's --radiosity takes, each once; with `scales` also "joined:1/4", whose
// number behind the slash is --radiosity-scale's. Throws as split_list.
std::vector<std::string> split_radiosity(const std::string& text, bool scales);

// Whole numbers from 1.
std::vector<int> split_numbers(const std::string& option, const std::string& text);

// The folder's own path, made where it is not there. Throws Failure(Exit::file).
std::filesystem::path make_folder(const std::filesystem::path& folder);

}  // namespace mpipov
