// noise.json: which serial renders lie in a folder, as serial_set_json.cpp writes it. Pure.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace mpipov {

struct ListedRender {
    std::string name;
    std::vector<std::string> argv;
    std::filesystem::path image;  // relative to the folder
    double wall_seconds = 0, cpu_seconds = 0;
};

// NOLINTNEXTLINE(bugprone-exception-escape): moving JSON only asserts
struct SerialManifest {
    std::vector<std::string> arguments;
    nlohmann::json identity;
    int wanted = 0;
    bool method_1 = false;
    std::map<std::string, ListedRender> references;  // "default", and maybe "oneblock"
    std::string why_not;
    bool exact = false;
    int tried = 0;
    std::vector<ListedRender> renders;
};

// Throws std::runtime_error, naming what is missing or of the wrong kind.
SerialManifest manifest_from_json(const nlohmann::json& json);

}  // namespace mpipov
