// The serial renders of a scene that images in sections are judged by: the references, and others
// that are equally right. A folder of them (`noise --out`) serves any number of judgements
// (`seams --serial`).
#pragma once

#include "compare.h"
#include "noise_floor.h"
#include "run_record.h"
#include "serial_render.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mpipov {

inline constexpr int fewest_noise_renders = 3, default_noise_renders = 12;

// What is known of the scene before anything of it is rendered as a whole.
// NOLINTNEXTLINE(bugprone-exception-escape): moving JSON only asserts
struct SceneAsked {
    std::string povray_version;
    std::string name, file;  // file: as the user gave it
    // What was rendered: POV-Ray, settings, and the SHA-1 of every file that the scene is made of
    // (job_identity.h, which says what cannot be seen).
    nlohmann::json identity;
    bool order_dependent = false;
    std::vector<std::filesystem::path> library_paths;  // as POV-Ray searches them
    int longest_side = 0;                              // pixels
    long long pixels = 0;                              // of the region that is rendered
};

struct NoiseRender {
    SerialRender render;
    // With the serial reference; with the first case's seams where there is one.
    Comparison comparison;
};

struct NoiseReport {
    std::string why_not;  // not empty: there is no noise, or too little of it was found
    bool exact = false;
    int tried = 0;  // variants rendered, those that came out alike included
    std::vector<NoiseRender> renders;
    std::optional<NoiseFloor> floor;  // of the reference and the renders
};

struct SerialRequest {
    std::vector<std::string> arguments;   // the scene and POV-Ray's own, as the user gave them
    int renders = default_noise_renders;  // wanted, beside the reference
    std::string povray = "povray";
    bool one_block = false;  // the second reference, where antialiasing sees blocks
    SceneRules rules = {};
};

// NOLINTNEXTLINE(bugprone-exception-escape): moving JSON only asserts
struct SerialSet {
    SceneAsked scene;
    // "default": POV-Ray's blocks. "oneblock": all in one, the paper's scan line; only where
    // antialiasing of method 1 sees the difference.
    std::map<std::string, SerialRender> references;
    NoiseReport noise;  // compared with "default", without seams

    const SerialRender& reference() const { return references.at("default"); }
};

// No pixel depends on the order of rendering, or so few of them (one in a thousand) and so seldom
// that there is no noise to judge by: POV-Ray's shadow cache does that (docs/povray.md).
bool is_exact(const NoiseReport& noise);

// Throws Failure as run_probe and SerialRenderer::render do.
SerialSet render_serial_set(const SerialRequest& request, const std::filesystem::path& folder);

// Paths in the JSON are relative to `folder`.
nlohmann::json serial_json(const SerialRender& render, const std::filesystem::path& folder);
nlohmann::json to_json(const NoiseReport& noise, const std::filesystem::path& folder);
// noise.json.
nlohmann::json to_json(const SerialSet& set, const SerialRequest& request,
                       const std::filesystem::path& folder);

// `arguments` as the user gave them. Tells what `rules` mean for the scene where the user should
// know. Throws Failure as run_probe and confinement_by().
SceneAsked ask_scene(const std::vector<std::string>& arguments, const std::string& povray,
                     const SceneRules& rules);

// What an earlier render_serial_set left in `folder`. Asks POV-Ray about the scene again, and
// throws Failure(Exit::usage) where it is another now (any file of it, the settings, POV-Ray
// itself), where the arguments are others, or where there are fewer renders than `request` asks
// for; Failure(Exit::file) where it cannot be read, and as run_probe does.
SerialSet read_serial_set(const SerialRequest& request, const std::filesystem::path& folder);

// Compares the noise renders with the reference, with the seams of `run` where there is one, and
// measures the floor where it is not known yet.
void compare_noise(SerialSet& set, const std::optional<RunRecord>& run);

}  // namespace mpipov
