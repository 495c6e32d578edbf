// All that `mpipov-validate stability` found out about a scene, as JSON (stability.json) and as a
// table. Errors are in stored units, as in compare_report.h; null stands for what is undefined.
#pragma once

#include "compare.h"
#include "serial_set.h"
#include "stability_verdict.h"

#include <nlohmann/json.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mpipov {

// How the camera was moved: its place times 1 + move; by so much of a unit of the scene, where it
// is at the origin or the picture does not answer the former; by the scene itself.
enum class CameraWay { scale, shift, declared };
std::string to_string(CameraWay way);

struct CameraMove {
    double move = 0;
    SerialRender render;
    Comparison comparison;    // with the picture from where the camera is
    long long answering = 0;  // pixels that change by more than one level of 255

    // RMS error as part of full scale, divided by the move.
    std::optional<double> amplification() const;
};

struct Stability {
    SerialRender reference;  // the scene as it is
    int cameras = 0;         // statements that can be moved
    CameraWay way = CameraWay::scale;
    std::vector<CameraMove> moves;  // smallest first
    // A move of 1e-3, where the picture does not answer smaller ones: it could be moved at all.
    std::optional<CameraMove> control;
    std::optional<double> noise;                 // as in ConditioningFacts
    std::optional<ConditioningVerdict> verdict;  // none: not measured to the end
};

struct StabilityReport {
    std::filesystem::path folder;  // paths in the JSON are relative to it
    std::vector<std::string> arguments;
    std::map<std::string, std::string> versions;
    bool complete = false;
    std::string failure;
    std::optional<SceneAsked> scene;
    Stability found;
    std::filesystem::path map;  // empty: none was written
    bool keeps_images = true;   // false: what is gone when the program ends has no name
};

nlohmann::json to_json(const Stability& found, const std::filesystem::path& folder);
nlohmann::json to_json(const StabilityReport& report);

std::string to_table(const StabilityReport& report);

}  // namespace mpipov
