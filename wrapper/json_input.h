// Reading our JSON files so that what is wrong with one can be told to people.
#pragma once

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <stdexcept>
#include <string>

namespace mpipov {

// Without the ids that nlohmann-json puts before its messages: "[json.exception.type_error.302] ".
std::string plain_words(std::string message);

// Throws std::runtime_error "it lacks 'key'".
const nlohmann::json& member(const nlohmann::json& object, const std::string& key);

// Throws std::runtime_error too where it is of another type, and says which.
template <class T>
T member(const nlohmann::json& object, const std::string& key) {
    const nlohmann::json& value = member(object, key);
    try {
        return value.get<T>();
    } catch (const nlohmann::json::exception& error) {
        throw std::runtime_error(fmt::format("its '{}': {}", key, plain_words(error.what())));
    }
}

}  // namespace mpipov
