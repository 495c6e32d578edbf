#include "message_fields.h"

#include "json_input.h"
#include "message.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

namespace mpipov {
namespace {

using nlohmann::json;

constexpr double most_seconds = 1e9;  // no run takes so long
// Above any number of a section, and of attempts at it.
constexpr int most_sections = 1 << 30, most_attempts = 1 << 30;

template <class Read>
auto read(const json& head, const char* key, Read&& read_it) {
    try {
        return read_it(member(head, key));
    } catch (const std::exception& error) {
        throw std::runtime_error(fmt::format("a message between ranks is damaged: '{}': {}", key,
                                             plain_words(error.what())));
    }
}

template <class Number>
Number whole(const json& value, Number least, Number most) {
    const auto number = whole_number<Number>(value);
    if (number < least || number > most)
        throw std::runtime_error(
            fmt::format("must be from {} to {}, but is {}", least, most, number));
    return number;
}

double real(const json& value, double least, double most) {
    if (!value.is_number()) throw std::runtime_error("is no number");
    const auto number = value.get<double>();
    if (!(number >= least && number <= most))
        throw std::runtime_error(fmt::format("must be from {} to {}", least, most));
    return number;
}

const json& list(const json& value) {
    if (!value.is_array()) throw std::runtime_error("is no list");
    return value;
}

std::vector<std::string> list_of(const json& value, std::string (*one)(const json&)) {
    std::vector<std::string> texts;
    for (const json& text : list(value)) texts.push_back(one(text));
    return texts;
}

std::string name_from_json(const json& value) {
    std::string text = text_from_json(value);
    if (text.find('\0') != std::string::npos)
        throw std::runtime_error("is no text: it has a zero byte");
    return text;
}

}  // namespace

int MessageFields::number(const char* key, int least, int most) const {
    return read(head_, key, [&](const json& value) { return whole(value, least, most); });
}

int MessageFields::section() const {
    return number("section", 0, most_sections);
}

int MessageFields::attempt() const {
    return number("attempt", 0, most_attempts);
}

std::uint64_t MessageFields::size(const char* key, std::int64_t most) const {
    return read(head_, key, [&](const json& value) {
        return static_cast<std::uint64_t>(whole(value, std::int64_t{0}, most));
    });
}

double MessageFields::seconds(const char* key) const {
    return read(head_, key, [](const json& value) { return real(value, 0, most_seconds); });
}

std::optional<double> MessageFields::seconds_or_none(const char* key) const {
    return read(head_, key, [](const json& value) {
        return value.is_null() ? std::optional<double>() : real(value, 0, most_seconds);
    });
}

double MessageFields::part(const char* key) const {
    return read(head_, key, [](const json& value) { return real(value, 0, 1); });
}

bool MessageFields::flag(const char* key) const {
    return read(head_, key, [](const json& value) { return value.get<bool>(); });
}

Rect MessageFields::rect(const char* key) const {
    return read(head_, key, rect_from_json);
}

Exit MessageFields::code(const char* key) const {
    return static_cast<Exit>(
        number(key, static_cast<int>(Exit::usage), static_cast<int>(Exit::interrupted)));
}

std::string MessageFields::text(const char* key) const {
    return read(head_, key, name_from_json);
}

std::vector<std::string> MessageFields::texts(const char* key) const {
    return read(head_, key, [](const json& value) { return list_of(value, name_from_json); });
}

std::string MessageFields::said(const char* key) const {
    return read(head_, key, text_from_json);
}

std::vector<std::string> MessageFields::all_said(const char* key) const {
    return read(head_, key, [](const json& value) { return list_of(value, text_from_json); });
}

const json& MessageFields::array(const char* key) const {
    return *read(head_, key, [](const json& value) { return &list(value); });
}

json text_to_json(const std::string& text) {
    try {
        json literal = text;
        literal.dump();
        return literal;
    } catch (const json::exception&) {
        json bytes = json::array();
        for (const char c : text) bytes.push_back(static_cast<unsigned char>(c));
        return bytes;
    }
}

json texts_to_json(const std::vector<std::string>& texts) {
    json list = json::array();
    for (const std::string& text : texts) list.push_back(text_to_json(text));
    return list;
}

std::string text_from_json(const json& value) {
    std::string text;
    if (value.is_array()) {
        for (const json& byte : value) {
            const int number = whole_number<int>(byte);
            if (number < 0 || number > std::numeric_limits<unsigned char>::max())
                throw std::runtime_error("is no text: not a byte");
            text += static_cast<char>(static_cast<unsigned char>(number));
        }
    } else if (value.is_string()) {
        text = value.get<std::string>();
    } else {
        throw std::runtime_error("is no text");
    }
    return text;
}

}  // namespace mpipov
