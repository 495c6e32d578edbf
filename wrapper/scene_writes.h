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
    bool computed = false;           // others do too: concat("a", ".txt"), a variable
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
// 4096 others). What the scene writes there stays in `folder`: of what it names it gets copies, and
// where it computes a name, of 200 files of at most 1 MiB, 16 MiB together; but never of one that
// may_be_read() of `readable` does not allow. Throws std::filesystem::filesystem_error,
// Failure(Exit::interrupted).
std::filesystem::path make_writable_view(const std::filesystem::path& folder,
                                         const std::filesystem::path& original,
                                         const SceneWrites& written,
                                         const std::vector<std::filesystem::path>& readable);

}  // namespace mpipov
