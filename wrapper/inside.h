// Whether one path leads into another.
#pragma once

#include <filesystem>

namespace mpipov {

// Whether `path` is `folder` or below it, by their names: both with links resolved, or both not.
inline bool lies_in(const std::filesystem::path& path, const std::filesystem::path& folder) {
    const std::filesystem::path inside = path.lexically_relative(folder);
    return !inside.empty() && *inside.begin() != "..";
}

}  // namespace mpipov
