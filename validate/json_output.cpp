#include "json_output.h"

#include "failure.h"
#include "part_file.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>

namespace mpipov {

namespace fs = std::filesystem;

void write_json(const std::string& target, const nlohmann::json& json) {
    const std::string text = json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
    const auto fail = [&](const std::string& why) {
        throw Failure(Exit::file, fmt::format("cannot write '{}': {}", target, why));
    };
    if (target == "-") {
        fmt::print("{}\n", text);  // main sees to it that it arrives
        return;
    }
    const auto write_to = [&](const fs::path& file) {
        std::ofstream out(file);
        out << text << '\n';
        if (!out.flush()) fail("is there such a folder, and room in it?");
    };
    std::error_code none;
    const fs::file_status status = fs::status(target, none);
    if (fs::exists(status) && !fs::is_regular_file(status)) {  // /dev/null must not be replaced
        write_to(target);
        return;
    }
    try {
        PartFile part(target);
        write_to(part.path());
        part.take_place();
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
