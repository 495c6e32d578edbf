// A launch of POV-Ray and the folder that it writes into.
#pragma once

#include "child_process.h"

#include <filesystem>

namespace mpipov {

// Removed with all that is in it.
class LaunchFolder {
  public:
    // Makes the folder; throws std::filesystem::filesystem_error.
    explicit LaunchFolder(std::filesystem::path path);
    LaunchFolder(LaunchFolder&& other) noexcept;
    LaunchFolder& operator=(LaunchFolder&&) = delete;
    ~LaunchFolder();
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

struct PreparedLaunch {
    LaunchFolder folder;  // before the child, which must be gone when it is removed
    ChildProcess child;
};

}  // namespace mpipov
