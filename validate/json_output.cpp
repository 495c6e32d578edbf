#include "json_output.h"

#include "failure.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace mpipov {

void write_json(const std::string& target, const nlohmann::json& json) {
    const std::string text = json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
    const auto fail = [&](const std::string& why) {
        throw Failure(Exit::file, fmt::format("cannot write '{}': {}", target, why));
    };
    if (target == "-") {
        if (std::puts(text.c_str()) < 0 || std::fflush(stdout) != 0) fail("standard output");
        return;
    }
    const std::string part = target + ".part";
    {
        std::ofstream out(part);
        out << text << '\n';
        if (!out.flush()) fail("is there such a folder, and room in it?");
    }
    std::error_code error;
    std::filesystem::rename(part, target, error);
    if (error) fail(error.message());
}

}  // namespace mpipov
