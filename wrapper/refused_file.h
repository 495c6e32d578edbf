// What a launch that failed was not let do, by what it printed, and what of that can be allowed
// without thought: a scene chooses the names, and prints what looks like POV-Ray's own words.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace mpipov {

struct RefusedFile {
    std::string name;  // as the scene has it
    bool to_write = false;
};

// The file that POV-Ray could not open and therefore ended. Nothing where its last words are a
// scene's own (#error), whatever stands before them (#warning, #debug).
std::optional<RefusedFile> refused_file(std::string_view output);

// Whether a message may say `--allow-read 'folder'`, for the user to copy: not the home folder, nor
// what holds it or is hidden in it, nor the system's own, nor one that everybody may write to, nor
// a name that a shell would take for more than one. `folder` with its links resolved.
bool may_be_proposed(const std::filesystem::path& folder, const std::filesystem::path& home);

}  // namespace mpipov
