#include "scene_rules.h"

#include "option_values.h"

#include <fmt/format.h>

#include <cstdio>

namespace mpipov {

void add_scene_rules(CLI::App& app, SceneRules& rules) {
    add_keeping_options(app, rules.options, rules.given);
}

Confinement confinement_by(const SceneRules& rules, const std::string& povray,
                           const std::vector<std::string>& arguments,
                           const std::filesystem::path& own) {
    Options options = rules.options;
    options.povray = povray;
    options.povray_arguments = arguments;
    require_passable(arguments);
    return {options, resources_of_host(1), own};
}

void tell_note(const Confinement& confinement) {
    if (const std::string note = confinement.note(); !note.empty())
        fmt::print(stderr, "mpipov-validate: {}\n", note);
}

}  // namespace mpipov
