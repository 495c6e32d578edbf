// What a program prints as its result.
#pragma once

#include <string_view>

namespace mpipov {

// Throws Failure(Exit::file) where it did not arrive: a result that a full disk swallowed is none.
void print_result(std::string_view text);

}  // namespace mpipov
