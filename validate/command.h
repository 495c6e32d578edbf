// A subcommand of mpipov-validate: what main needs to know of it.
#pragma once

#include "failure.h"

#include <CLI/App.hpp>

#include <functional>

namespace mpipov {

struct Command {
    CLI::App* app = nullptr;    // owned by the program's own CLI::App
    std::function<Exit()> run;  // once the arguments were parsed; throws Failure
};

}  // namespace mpipov
