// What a scene may do where we start POV-Ray ourselves, and in the mpipov that we start: by
// mpipov's own options (docs/security.md).
#pragma once

#include "confinement.h"
#include "options.h"

#include <CLI/App.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace mpipov {

struct SceneRules {
    Options options;                 // only what add_scene_rules() sets is read
    std::vector<std::string> given;  // the same for mpipov's command line
};

// `rules` must live until `app` has parsed.
void add_scene_rules(CLI::App& app, SceneRules& rules);

// Of launches of `povray` one at a time, each of which may take what this host has. `arguments` as
// the user gave them; `own`: a folder that is there as long as the launches. Throws Failure as
// Confinement's constructor does.
Confinement confinement_by(const SceneRules& rules, const std::string& povray,
                           const std::vector<std::string>& arguments,
                           const std::filesystem::path& own);

// Tells on standard error what the user should know of it before he waits; once a command.
void tell_note(const Confinement& confinement);

}  // namespace mpipov
