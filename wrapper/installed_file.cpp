#include "installed_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <stdexcept>

namespace mpipov {

namespace fs = std::filesystem;

fs::path program_folder() {
    return fs::read_symlink("/proc/self/exe").parent_path();
}

fs::path find_installed(const InstalledFile& wanted) {
    const char* named = wanted.variable.empty() ? nullptr : std::getenv(wanted.variable.c_str());
    if (named != nullptr && *named != '\0') {
        if (::access(named, X_OK) == 0) return fs::absolute(named);
        throw std::runtime_error(
            fmt::format("{} names '{}', which is no executable file: correct or unset it",
                        wanted.variable, named));
    }
    const fs::path here = program_folder();
    const std::array<fs::path, 2> places{here / wanted.name,
                                         (here / wanted.folder / wanted.name).lexically_normal()};
    for (const fs::path& place : places)
        if (::access(place.c_str(), R_OK) == 0) return place;
    throw std::runtime_error(fmt::format(
        "cannot find {}, neither as '{}' nor as '{}': build or install it with mpipov{}",
        wanted.name, places[0].string(), places[1].string(),
        wanted.variable.empty() ? "" : ", or let " + wanted.variable + " name it"));
}

}  // namespace mpipov
