#include "shipped_file.h"

#include "failure.h"
#include "installed_file.h"

#include <fmt/format.h>

namespace mpipov {

std::filesystem::path shipped_file(const std::filesystem::path& path) {
    std::filesystem::path file = (program_folder() / path).lexically_normal();
    std::error_code error;
    if (!std::filesystem::exists(file, error))
        throw Failure(Exit::file,
                      fmt::format("cannot find '{}': install mpipov as a whole", file.string()));
    return file;
}

}  // namespace mpipov
