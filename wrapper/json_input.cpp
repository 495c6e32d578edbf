#include "json_input.h"

namespace mpipov {

std::string plain_words(std::string message) {
    for (;;) {
        const std::size_t begin = message.find("[json.exception.");
        const std::size_t end = message.find("] ", begin);
        if (begin == std::string::npos || end == std::string::npos) return message;
        message.erase(begin, end + 2 - begin);
    }
}

const nlohmann::json& member(const nlohmann::json& object, const std::string& key) {
    const auto found = object.find(key);
    if (found == object.end()) throw std::runtime_error(fmt::format("it lacks '{}'", key));
    return *found;
}

}  // namespace mpipov
