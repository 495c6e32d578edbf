// Serial renders by POV-Ray itself: the reference, and others that are equally right.
#pragma once

#include "noise_variants.h"
#include "povray_text.h"
#include "scene_rules.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace mpipov {

struct SerialRender {
    std::string name;
    std::vector<std::string> argv;  // but for the output file
    std::filesystem::path image;
    double wall_seconds = 0, cpu_seconds = 0;
    LaunchReport report;
    std::string text;  // all that POV-Ray printed, as it broke the lines
};

class SerialRenderer {
  public:
    // `user_arguments` as the user gave them. `scratch`: below it each launch has the folder that
    // it may write into. `reads`: what a scene may read besides, once it is there. Throws Failure
    // as confinement_by().
    SerialRenderer(std::string povray, const std::vector<std::string>& user_arguments,
                   std::filesystem::path scratch, const SceneRules& rules,
                   std::vector<std::filesystem::path> reads = {});

    // `more` comes after the user's arguments. The image is put into `folder` as `name`
    // with POV-Ray's extension. Throws Failure: usage or scene with POV-Ray's words, file,
    // interrupted.
    SerialRender render(const std::string& name, const std::vector<std::string>& more,
                        const std::filesystem::path& folder, int threads = 1) const;

    const Confinement& confinement() const { return confinement_; }

  private:
    std::string povray_;
    std::vector<std::string> arguments_;
    std::filesystem::path scratch_;
    std::vector<std::filesystem::path> reads_;
    Confinement confinement_;
};

struct NoiseRenders {
    bool exact = false;                 // every variant was the serial image: `renders` is empty
    int tried = 0;                      // variants that were rendered
    std::vector<SerialRender> renders;  // all different, and different from the reference
};

// `wanted` renders that differ from the reference and from each other, or fewer where there are no
// more. `order_dependent`: known to be (a scene of which nothing is known is called exact after
// variants_to_call_exact). `told` is called after each render. Throws as SerialRenderer::render.
struct NoiseRequest {
    int wanted = 12;
    bool order_dependent = false, keep_blocks = true;
    std::filesystem::path folder;
    std::function<void(const std::string& name)> told;
};
NoiseRenders render_noise(const SerialRenderer& renderer, const SerialRender& reference,
                          const NoiseRequest& request);

// Whether antialiasing is of method 1: the kind that sees render blocks.
bool sees_blocks(const LaunchReport& report);

}  // namespace mpipov
