// A copy of a scene whose camera can be moved by a declared value, beside the user's own files.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace mpipov {

struct MovableScene {
    // For POV-Ray, behind the user's own: the copy as its scene. Empty where the scene itself uses
    // the declared value.
    std::vector<std::string> arguments;
    bool moves_itself = false;
    int cameras = 0;  // statements that were found, 0: the copy was given one
};

// `scene` as POV-Ray was given it; what it includes is looked for as POV-Ray does: in the current
// folder, then in `library_paths` in their order. Of files without a camera statement, and without
// one in what they include, no copy is made, nor of those that `may_read` says a scene may not
// read. Names that the scene computes are not seen. Throws
// Failure(Exit::scene) where the scene cannot be read, Failure(Exit::file) where `folder` cannot be
// written.
MovableScene make_movable(const std::string& scene,
                          const std::vector<std::filesystem::path>& library_paths,
                          const std::filesystem::path& folder,
                          const std::function<bool(const std::filesystem::path&)>& may_read);

}  // namespace mpipov
