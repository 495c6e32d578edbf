// Where --json goes.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace mpipov {

// `target`: a file, written whole or not at all; a device or pipe, written to; or "-" for standard
// output. Throws Failure(Exit::file).
void write_json(const std::string& target, const nlohmann::json& json);

// Throws Failure(Exit::usage) where what `option` is to write is one of the files that are read, by
// whatever name. An empty target is none.
void require_other_file(const std::string& option, const std::filesystem::path& target,
                        const std::vector<std::filesystem::path>& read);

// The same file, or that would be; empty paths are none.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace mpipov
