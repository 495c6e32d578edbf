// Finds what was built or installed with this program: beside it in the build folder, in a folder
// of its own after an install.
#pragma once

#include <filesystem>
#include <string>

namespace mpipov {

struct InstalledFile {
    std::string name;      // mpipov-guard
    std::string folder;    // after an install, from the program's: ../libexec/mpipov
    std::string variable;  // of the environment, that may name another; "": none
};

// The folder that this program lies in.
std::filesystem::path program_folder();

// Throws std::runtime_error that says where it was looked for.
std::filesystem::path find_installed(const InstalledFile& wanted);

}  // namespace mpipov
