// What an option that takes a number accepts, for CLI11.
#pragma once

#include <CLI/App.hpp>

#include <string>

namespace mpipov {

// Finite numbers that are `good`; others are "no <what>". `shown`: in the help.
CLI::Validator finite_number(std::string what, std::string shown, bool (*good)(double));

}  // namespace mpipov
