#include "other_file.h"

#include "failure.h"

#include <fmt/format.h>

#include <system_error>

namespace mpipov {

namespace fs = std::filesystem;

bool same_file(const fs::path& a, const fs::path& b) {
    if (a.empty() || b.empty()) return false;
    std::error_code none;
    if (fs::equivalent(a, b, none)) return true;
    return fs::weakly_canonical(fs::absolute(a), none) ==
           fs::weakly_canonical(fs::absolute(b), none);
}

void require_other_file(const std::string& option, const fs::path& target,
                        const std::vector<fs::path>& read) {
    for (const fs::path& file : read)
        if (same_file(target, file))
            throw Failure(Exit::usage, fmt::format("{} would overwrite '{}': name another file",
                                                   option, file.string()));
}

}  // namespace mpipov
