// Why a launch of POV-Ray failed, for the user.
#pragma once

#include "child_process.h"
#include "confinement.h"

#include <string>
#include <string_view>

namespace mpipov {

// Of one that has ended. In POV-Ray's own words where it said something, with what can be done
// about it where a limit of ours was the cause.
std::string describe_end(const ChildProcess& child, const Confinement& confinement);

// Of one that said this.
std::string describe_failure(std::string_view output, const Confinement& confinement);

}  // namespace mpipov
