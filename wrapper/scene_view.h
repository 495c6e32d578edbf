// What a rank sees of a scene on its host: the same for ranks whose POV-Ray would read the same
// files.
#pragma once

#include "probe.h"
#include "scene_files.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace mpipov {

struct SceneView {
    std::map<std::string, std::string>
        files;             // as they are named -> fingerprint(); "": cannot be read
    std::string ini_sha1;  // of what POV-Ray reads as its povray.ini; "": nothing
};

// `arguments` are POV-Ray's.
SceneRequest scene_request(const Probe& probe, const std::vector<std::string>& arguments);

// Reads them all, and `more` where they are there: a rank that lacks the scene does not know what
// its text names. Throws nothing but std::bad_alloc.
SceneView view_scene(const SceneRequest& request,
                     const std::vector<std::filesystem::path>& more = {});

// In what `theirs` differs: "lacks 'scene.pov'", "has another 'tile.png'", "has 'tile.png', which
// rank 0 does not see", "has another povray.ini"; "" where they are the same.
std::string difference(const SceneView& ours, const SceneView& theirs);

// POV-Ray reads the first of them and no other: $POVINI, ./povray.ini, ~/.povray/3.7/povray.ini,
// ~/.povrayrc, /etc/povray/3.7/povray.ini, /etc/povray.ini (docs/povray.md). Empty: there is none.
std::filesystem::path povray_ini();

// Ranks for which this is the same text see the same files: of one machine, one mount namespace and
// one current folder. Empty where that cannot be told.
std::string point_of_view();

nlohmann::json to_json(const SceneRequest& request);
SceneRequest scene_request_from_json(const nlohmann::json& json);
nlohmann::json to_json(const SceneView& view);
SceneView scene_view_from_json(const nlohmann::json& json);

}  // namespace mpipov
