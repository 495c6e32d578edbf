#include "json_input.h"

#include <gmock/gmock.h>

#include <limits>
#include <sstream>

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

TEST(JsonInput, WholeNumbersAreNeverCutToFit) {
    for (const char* bad : {"4294967297", "-2147483649", "1.5", "true", "18446744073709551615"})
        EXPECT_NE(said_of({{"a", json::parse(bad)}}, "a"), "") << bad;
    EXPECT_EQ(said_of({{"a", 1.5}}, "a"), "its 'a': must be a whole number, but is a fraction");
    EXPECT_EQ(said_of({{"a", 4294967297}}, "a"), "its 'a': is out of range: 4294967297");
    EXPECT_EQ(member<int>({{"a", -2147483648LL}}, "a"), std::numeric_limits<int>::min());
    EXPECT_EQ(member<int>({{"a", 2147483647U}}, "a"), std::numeric_limits<int>::max());
    EXPECT_EQ(member<long long>({{"a", 4294967297}}, "a"), 4294967297);
    EXPECT_THROW(member<long long>({{"a", 9223372036854775808U}}, "a"), std::runtime_error);
    EXPECT_EQ(member<int>({{"a", 1}}, "a", 1), 1);
    EXPECT_THROW(member<int>({{"a", 0}}, "a", 1), std::runtime_error);
}

// Copying, comparing and printing recurse once a level.
TEST(JsonInput, WhatIsNestedDeeplyIsRefused) {
    const auto nested = [](std::size_t levels) {
        return std::string(levels, '[') + std::string(levels, ']');
    };
    EXPECT_TRUE(parse_json(std::string_view(nested(60))).is_array());
    std::istringstream deep(nested(1000000));
    EXPECT_THROW(parse_json(deep), std::runtime_error);
}

}  // namespace
}  // namespace mpipov
