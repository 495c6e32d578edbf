// Runs one of the Python scripts that come with mpipov-validate.
#pragma once

#include <string>
#include <vector>

namespace mpipov {

// The script lies in ../share/mpipov, seen from this program, both in the build folder and where it
// is installed. Runs it to its end with the interpreter that CMake found. Throws
// Failure(Exit::file) where it is not there, or, with the last line that it printed, where it
// cannot be started or fails, and Failure(Exit::interrupted).
void run_script(const std::string& name, const std::vector<std::string>& arguments);

}  // namespace mpipov
