#include "result_file.h"

#include "json_input.h"
#include "json_output.h"

#include <fstream>

namespace mpipov {

using nlohmann::json;

ResultFile::ResultFile(std::filesystem::path file, bool (*holds_results)(const json& earlier))
    : file_(std::move(file)) {
    try {
        std::ifstream in(file_);
        keeps_earlier_ = in && holds_results(parse_json(in));
    } catch (const std::exception&) {
        keeps_earlier_ = false;
    }
}

void ResultFile::write(const json& result) const {
    if (!keeps_earlier_) write_json(file_.string(), result);
}

}  // namespace mpipov
