// The members of a message's head, none of which is believed.
#pragma once

#include "failure.h"
#include "section.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mpipov {

// Reads a head that must outlive it. Everything throws std::runtime_error, which names the member,
// where it is missing, of another type or out of bounds.
class MessageFields {
  public:
    explicit MessageFields(const nlohmann::json& head) : head_(head) {}

    int number(const char* key, int least, int most) const;
    // Which launch a message is about: a section, and the attempt at it.
    int section() const;
    int attempt() const;
    // Of bytes, or of anything that may be more than an int holds.
    std::uint64_t size(const char* key, std::int64_t most) const;
    double seconds(const char* key) const;  // 0 or more
    std::optional<double> seconds_or_none(const char* key) const;
    double part(const char* key) const;  // from 0 to 1
    bool flag(const char* key) const;
    Rect rect(const char* key) const;
    Exit code(const char* key) const;  // of what did not work out
    // Names and arguments, without a zero byte: nothing that the kernel is given may have one.
    std::string text(const char* key) const;
    std::vector<std::string> texts(const char* key) const;
    // What is for people to read, and may have any.
    std::string said(const char* key) const;
    std::vector<std::string> all_said(const char* key) const;
    const nlohmann::json& array(const char* key) const;

  private:
    const nlohmann::json& head_;
};

// File names and arguments are bytes, and JSON holds UTF-8 alone: what is none goes as an array of
// its bytes, and comes out as it was.
nlohmann::json text_to_json(const std::string& text);
nlohmann::json texts_to_json(const std::vector<std::string>& texts);
// Throws std::runtime_error.
std::string text_from_json(const nlohmann::json& json);

}  // namespace mpipov
