#include "standard_output.h"

#include "failure.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace mpipov {

void print_result(std::string_view text) {
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (written && std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
    throw Failure(Exit::file,
                  fmt::format("cannot write to standard output: {}", std::strerror(errno)));
}

}  // namespace mpipov
