#include "json_input.h"

namespace mpipov {
namespace {

using nlohmann::json;

template <class Input>
json parse(Input&& input) {
    try {
        return json::parse(std::forward<Input>(input), [](int depth, json::parse_event_t /*event*/,
                                                          json& /*parsed*/) {
            if (depth > deepest_json)
                throw std::runtime_error(fmt::format("is nested more than {} deep", deepest_json));
            return true;
        });
    } catch (const json::exception& error) {
        throw std::runtime_error(plain_words(error.what()));
    }
}

}  // namespace

json parse_json(std::istream& in) {
    return parse(in);
}

json parse_json(std::string_view text) {
    return parse(text);
}

std::string plain_words(std::string message) {
    for (;;) {
        const std::size_t begin = message.find("[json.exception.");
        const std::size_t end = message.find("] ", begin);
        if (begin == std::string::npos || end == std::string::npos) return message;
        message.erase(begin, end + 2 - begin);
    }
}

const json& member(const json& object, const std::string& key) {
    const auto found = object.find(key);
    if (found == object.end()) throw std::runtime_error(fmt::format("it lacks '{}'", key));
    return *found;
}

}  // namespace mpipov
