// Scenes that write files (#fopen ... write), and a folder in which they can.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mpipov {

struct SceneWrites {
    bool any = false;
    std::vector<std::string> names;  // those that stand there as string literals
};

// What a scene's text says, comments included.
SceneWrites writes_in(std::string_view text);

// Of all files that the arguments name and what these name in turn, as scene_files() finds them.
SceneWrites writes_of_scene(const std::vector<std::string>& arguments,
                            const std::vector<std::filesystem::path>& library_paths);

// Of all files below `folder`, which holds nothing but a scene.
SceneWrites writes_in_folder(const std::filesystem::path& folder);

// Makes `folder` look like the whole file system to a program that runs in the path that is
// returned: there lies a link to everything that lies in `original`, and so do links beside each
// folder that leads to it, so that names which begin with ../ mean the same (not beside more than
// 4096 others). What the scene writes there stays in `folder`: of those names it gets copies.
// Throws std::filesystem::filesystem_error.
std::filesystem::path make_writable_view(const std::filesystem::path& folder,
                                         const std::filesystem::path& original,
                                         const std::vector<std::string>& written);

}  // namespace mpipov
