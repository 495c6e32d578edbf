#include "prepared_launch.h"

#include <system_error>
#include <utility>

namespace mpipov {

LaunchFolder::LaunchFolder(std::filesystem::path path) : path_(std::move(path)) {
    std::filesystem::create_directory(path_);
}

LaunchFolder::LaunchFolder(LaunchFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}

LaunchFolder::~LaunchFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

}  // namespace mpipov
