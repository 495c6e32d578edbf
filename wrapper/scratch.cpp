#include "scratch.h"

#include "abandoned_scratch.h"
#include "failure.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

namespace mpipov {

// Longer than from making a folder to holding it.
constexpr double young_seconds = 60;

ScratchFolder::ScratchFolder(const std::string& purpose) {
    std::error_code error;
    std::filesystem::path base = std::filesystem::temp_directory_path(error);
    if (error) base = "/tmp";
    // POV-Ray's options have no way to write one.
    if (base.string().find('"') != std::string::npos)
        throw Failure(
            Exit::file,
            fmt::format("the temporary folder '{}' has a quotation mark in its name, which "
                        "POV-Ray cannot be told: set TMPDIR to another one",
                        base.string()));
    // POV-Ray may run in another folder than ours.
    base = std::filesystem::absolute(base);
    std::string name = (base / fmt::format("mpipov-{}.XXXXXX", purpose)).string();
    if (mkdtemp(name.data()) == nullptr)
        throw Failure(Exit::file, fmt::format("cannot make a temporary folder in '{}': {}",
                                              base.string(), std::strerror(errno)));
    path_ = name;
    held_ = hold(path_);
    remove_abandoned_scratch(base, young_seconds);
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace mpipov
