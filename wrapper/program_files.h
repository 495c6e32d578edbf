// Which files a program needs to run at all.
#pragma once

#include "landlock.h"

#include <filesystem>
#include <string>

namespace mpipov {

// The file that execvp() runs for `program`; empty where there is none.
std::filesystem::path find_program(const std::string& program);

// POV-Ray's own: the program, the system's libraries and those that it is linked to (as its dynamic
// loader finds them), includes, settings and examples where it is installed and where Debian has
// them. Of a script (a wrapper around POV-Ray) nobody knows what it runs: the system's programs and
// settings, itself, the programs beside it, and the libraries of LD_LIBRARY_PATH. `home` is the
// user's; may be empty.
FileAccess files_of_program(const std::filesystem::path& program,
                            const std::filesystem::path& home = {});

// LD_LIBRARY_PATH as POV-Ray may have it, whatever folder it runs in: none of its parts is empty,
// which would mean that folder, or relative.
std::string library_path_for_scenes();

}  // namespace mpipov
