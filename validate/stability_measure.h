// Renders a scene serially from where its camera is and from next to it.
#pragma once

#include "answer_map.h"
#include "stability_report.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mpipov {

struct StabilityRequest {
    std::vector<std::string> arguments;  // scene and POV-Ray's own, as the user gave them
    std::string povray = "povray";
    std::filesystem::path folder;           // of the images
    std::optional<SerialRender> reference;  // of these arguments; none: it is rendered
    // The largest mean error between equally right renders, where it is known already.
    std::optional<double> noise;
    // In an ill-conditioned scene: more moves of next to nothing for the map. One of them is
    // answered by some of the pixels that rounding decides about, five more by nearly all.
    bool full_map = false;
    std::function<void()> told = [] {};  // after each render
    SceneRules rules = {};
};

// `found` holds what was found until a failure. Throws Failure as SerialRenderer::render, and
// Failure(Exit::scene) where the camera cannot be moved: the text has no camera that POV-Ray comes
// to, or the copy whose camera has not moved is not the picture of the scene itself.
AnswerMap measure_stability(const StabilityRequest& request, const SceneAsked& scene,
                            Stability& found);

}  // namespace mpipov
