#include "json_input.h"

#include <gmock/gmock.h>

namespace mpipov {
namespace {

using nlohmann::json;

std::string said_of(const json& object, const std::string& key) {
    try {
        member<int>(object, key);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return {};
}

TEST(JsonInput, MessagesCarryNoIds) {
    EXPECT_EQ(plain_words("[json.exception.type_error.302] type"), "type");
    EXPECT_EQ(
        plain_words("cannot read 'a': [json.exception.parse_error.101] x [json.exception.y] z"),
        "cannot read 'a': x z");
    EXPECT_EQ(plain_words("[json.exception."), "[json.exception.");
    EXPECT_EQ(plain_words(""), "");
}

TEST(JsonInput, WhatLacksOrIsOtherwiseIsNamed) {
    EXPECT_EQ(member<int>({{"a", 7}}, "a"), 7);
    EXPECT_EQ(said_of({{"a", 7}}, "b"), "it lacks 'b'");
    EXPECT_EQ(said_of(json::array(), "b"), "it lacks 'b'");
    EXPECT_EQ(said_of({{"a", "7"}}, "a"), "its 'a': must be a whole number, but is string");
}

}  // namespace
}  // namespace mpipov
