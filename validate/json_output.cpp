#include "json_output.h"

#include "failure.h"
#include "part_file.h"

#include <fmt/format.h>

#include <cstdio>

namespace mpipov {

namespace fs = std::filesystem;

void write_json(const std::string& target, const nlohmann::json& json) {
    const std::string text = json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
    if (target == "-") {
        fmt::print("{}\n", text);  // main sees to it that it arrives
        return;
    }
    try {
        write_whole(target, text + '\n');
    } catch (const Failure&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw Failure(Exit::file, error.what());
    }
}

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
