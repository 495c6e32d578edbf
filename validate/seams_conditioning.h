// Whether a scene's seams are to be blamed, or the scene: measured where a first case would be.
#pragma once

#include "answer_map.h"
#include "scene_rules.h"
#include "seams_report.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mpipov {

class SeamsConditioning {
  public:
    // `folder`: where the renders from moved cameras go.
    SeamsConditioning(std::vector<std::string> arguments, std::string povray, SceneRules rules,
                      std::filesystem::path folder)
        : arguments_(std::move(arguments)),
          povray_(std::move(povray)),
          rules_(std::move(rules)),
          folder_(std::move(folder)) {}

    // Of a case that is not as it should be, and was compared: where the scene is ill-conditioned
    // and no pixel differs by more than it itself or one beside it answers to a move of next to
    // nothing, the verdict is another. What was found of the scene is put into the report, also why
    // nothing was. Throws Failure(Exit::interrupted).
    void reconsider(SeamsCase& one, const std::filesystem::path& reference, SeamsReport& report);

  private:
    void measure(SeamsReport& report);

    std::vector<std::string> arguments_;
    std::string povray_;
    SceneRules rules_;
    std::filesystem::path folder_;
    std::optional<AnswerMap> map_;
};

}  // namespace mpipov
