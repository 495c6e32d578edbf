// Where --json goes.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace mpipov {

// `target`: a file, written whole or not at all; a device or pipe, written to; or "-" for standard
// output. Throws Failure(Exit::file).
void write_json(const std::string& target, const nlohmann::json& json);

}  // namespace mpipov
