// Reading our JSON files so that what is wrong with one can be told to people.
#pragma once

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <istream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace mpipov {

// What we write is nested less than ten deep. Copying, comparing and printing recurse once a level,
// so that a file of brackets would overflow the stack long after it was read.
constexpr int deepest_json = 64;

// Throws std::runtime_error where it is no JSON, or is nested deeper.
nlohmann::json parse_json(std::istream& in);
nlohmann::json parse_json(std::string_view text);

// Without the ids that nlohmann-json puts before its messages: "[json.exception.type_error.302] ".
std::string plain_words(std::string message);

// Throws std::runtime_error "it lacks 'key'".
const nlohmann::json& member(const nlohmann::json& object, const std::string& key);

// A whole number that a T can hold: get<int>() makes 1 of 4294967297, of 1.5 and of true.
// Throws std::runtime_error.
template <class T>
T whole_number(const nlohmann::json& value) {
    static_assert(std::is_integral_v<T> && std::is_signed_v<T>);
    if (!value.is_number_integer())
        throw std::runtime_error(fmt::format("must be a whole number, but is {}",
                                             value.is_number() ? "a fraction" : value.type_name()));
    // An unsigned one may be more than the largest signed one.
    const bool fits = value.is_number_unsigned() ? std::in_range<T>(value.get<std::uint64_t>())
                                                 : std::in_range<T>(value.get<std::int64_t>());
    if (!fits) throw std::runtime_error(fmt::format("is out of range: {}", value.dump()));
    return static_cast<T>(value.get<std::int64_t>());
}

// Throws std::runtime_error too where it is of another type, and says which.
template <class T>
T member(const nlohmann::json& object, const std::string& key) {
    const nlohmann::json& value = member(object, key);
    try {
        if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>)
            return whole_number<T>(value);
        else
            return value.get<T>();
    } catch (const std::exception& error) {
        throw std::runtime_error(fmt::format("its '{}': {}", key, plain_words(error.what())));
    }
}

// The same, not less than `least`.
template <class T>
T member(const nlohmann::json& object, const std::string& key, T least) {
    const T value = member<T>(object, key);
    if (value < least)
        throw std::runtime_error(
            fmt::format("its '{}': must be {} or more, but is {}", key, least, value));
    return value;
}

}  // namespace mpipov
