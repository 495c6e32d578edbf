// The pack of a scene as rank 0 makes it: which files go, where their bytes come from, and what
// POV-Ray is told in a copy.
#pragma once

#include "scene_pack.h"
#include "scene_view.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mpipov {

struct Packing {
    ScenePack pack;
    // Of each file of the pack: where it lies here, or its text where that was rewritten.
    struct Source {
        std::filesystem::path file;
        std::optional<std::string> text;
    };
    std::vector<Source> sources;
    std::vector<std::string> arguments;  // POV-Ray's, for a launch in the copy
    // Not in it, because POV-Ray would not find them there: named by their absolute names in the
    // scene's text.
    std::vector<std::filesystem::path> absolute;
};

// Whether a file of this host, links followed, may leave it.
using MayGo = std::function<bool(const std::filesystem::path&)>;

// `arguments` are POV-Ray's, `ours` what rank 0 sees. Throws Failure(Exit::file): a file that the
// scene names and that may not go; more than the limits allow.
Packing pack_scene(const SceneRequest& request, const std::vector<std::string>& arguments,
                   const SceneView& ours, const MayGo& may_go, const PackLimits& limits = {});

}  // namespace mpipov
