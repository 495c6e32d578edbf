// Runs a program to its end, so that Ctrl-C ends it too.
#pragma once

#include "child_process.h"
#include "failure.h"

#include <string>

namespace mpipov {

// `output` may be null. Throws Failure(Exit::interrupted), and Failure(Exit::file) where the
// program cannot be started for want of processes or descriptors. That it does not exist is exit
// code 127.
ChildResult run_child(const ChildRequest& request, std::string* output);

// Of a program that exited with 127.
std::string povray_not_found(const std::string& povray);
std::string mpiexec_not_found(const std::string& mpiexec);

// Why mpipov failed, under that mpiexec: its own exit code where it is usage or file, and scene for
// all else.
Failure mpipov_failure(const ChildResult& result, const std::string& output,
                       const std::string& mpiexec);

// The last line of a program's output that is not blank; "it printed nothing".
std::string last_line(std::string_view text);

}  // namespace mpipov
