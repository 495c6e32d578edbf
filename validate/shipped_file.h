// Finds what is built and installed together with mpipov-validate.
#pragma once

#include <filesystem>

namespace mpipov {

// `path` is relative to the folder that this program lies in, and the same in the build folder and
// where it is installed. Throws Failure(Exit::file) where it is not there.
std::filesystem::path shipped_file(const std::filesystem::path& path);

}  // namespace mpipov
