// Which files a program needs to run at all.
#pragma once

#include "landlock.h"

#include <filesystem>
#include <string>

namespace mpipov {

// The file that execvp() runs for `program`; empty where there is none.
std::filesystem::path find_program(const std::string& program);

// POV-Ray's own: the program, the system's libraries and those of LD_LIBRARY_PATH, includes,
// settings and examples where it is installed and where Debian has them. Of a script (a wrapper
// around POV-Ray) nobody knows what it runs: the system's programs and settings, and its folder.
FileAccess files_of_program(const std::filesystem::path& program);

}  // namespace mpipov
