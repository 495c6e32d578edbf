// Which machine a time was measured on.
#pragma once

#include <string>

namespace mpipov {

// The processor as Linux calls it; empty where it does not say.
std::string cpu_name();

}  // namespace mpipov
