// Runs a program to its end, so that Ctrl-C ends it too.
#pragma once

#include "child_process.h"

#include <string>

namespace mpipov {

// `output` may be null. Throws Failure(Exit::interrupted), and Failure(Exit::file) where the
// program cannot be started for want of processes or descriptors. That it does not exist is exit
// code 127.
ChildResult run_child(const ChildRequest& request, std::string* output);

// The last line of a program's output that is not blank; "it printed nothing".
std::string last_line(std::string_view text);

}  // namespace mpipov
