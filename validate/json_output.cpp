#include "json_output.h"

#include "part_file.h"

#include <fmt/format.h>

#include <cstdio>

namespace mpipov {

void write_json(const std::string& target, const nlohmann::json& json) {
    const std::string text = json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
    if (target == "-") {
        fmt::print("{}\n", text);  // main sees to it that it arrives
        return;
    }
    write_whole(target, text + '\n');
}

}  // namespace mpipov
