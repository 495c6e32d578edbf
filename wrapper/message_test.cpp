#include "message.h"

#include "section.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <string>

namespace mpipov {
namespace {

Message sample(MessageKind kind, std::size_t body_bytes) {
    Message message;
    message.kind = kind;
    message.peer = 3;
    message.head = {{"section", 7}, {"name", "Übersicht"}, {"rect", {0, 1, 2, 3}}};
    for (std::size_t i = 0; i < body_bytes; ++i)
        message.body.push_back(static_cast<std::byte>(i * 37 % 256));
    return message;
}

TEST(Message, EveryKindSurvivesTheRoundTrip) {
    for (int kind = 0; kind <= static_cast<int>(MessageKind::bye); ++kind)
        for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{100000}}) {
            const Message sent = sample(static_cast<MessageKind>(kind), size);
            const Message received = unpack(pack(sent), 5);
            EXPECT_EQ(received.kind, sent.kind);
            EXPECT_EQ(received.peer, 5) << "the sender is told by the transport";
            EXPECT_EQ(received.head, sent.head);
            EXPECT_EQ(received.body, sent.body);
        }
}

TEST(Message, AnEmptyHeadIsAllowed) {
    Message sent;
    sent.head = nlohmann::json::object();
    EXPECT_EQ(unpack(pack(sent), 0).head, nlohmann::json::object());
    Message without;
    EXPECT_TRUE(unpack(pack(without), 0).head.is_null());
}

// File names and POV-Ray's texts may be anything.
TEST(Message, TextThatIsNoUtf8DoesNotStopIt) {
    Message sent = sample(MessageKind::failed, 0);
    sent.head["why"] = "caf\xe9 \xff";
    const auto why = unpack(pack(sent), 0).head.at("why").get<std::string>();
    EXPECT_EQ(why.substr(0, 3), "caf");
}

TEST(Message, TheLargestBandFits) {
    const Message band = sample(MessageKind::band, max_band_bytes);
    EXPECT_EQ(unpack(pack(band), 1).body.size(), max_band_bytes);
}

TEST(Message, WhatIsNoMessageIsRefused) {
    const std::vector<std::byte> good = pack(sample(MessageKind::band, 10));
    EXPECT_THROW(unpack({}, 0), std::runtime_error);
    EXPECT_THROW(unpack(std::span(good).first(4), 0), std::runtime_error);

    std::vector<std::byte> bad = good;
    bad[0] = std::byte{200};
    EXPECT_THROW(unpack(bad, 0), std::runtime_error) << "unknown kind";

    bad = good;
    bad[3] = std::byte{0xff};
    EXPECT_THROW(unpack(bad, 0), std::runtime_error) << "a head longer than the message";

    bad = good;
    bad[5] = std::byte{'x'};
    EXPECT_THROW(unpack(bad, 0), std::runtime_error) << "a head that is no JSON";

    const std::vector<std::byte> huge(max_message_bytes + 1);
    EXPECT_THROW(unpack(huge, 0), std::runtime_error) << "too long";
}

TEST(Message, DamagedBytesAreRefusedOrRead) {
    const std::vector<std::byte> good = pack(sample(MessageKind::done, 20));
    std::mt19937 random(7);
    int refused = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        std::vector<std::byte> bad = good;
        bad[random() % bad.size()] = static_cast<std::byte>(random() % 256);
        bad.resize(random() % 10 == 0 ? random() % bad.size() : bad.size());
        try {
            const Message message = unpack(bad, 0);
            EXPECT_LE(message.body.size(), bad.size());
        } catch (const std::runtime_error&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 100);
}

TEST(Message, RectanglesTravelAsFourNumbers) {
    const Rect rect{1, 2, 300000, 4};
    EXPECT_EQ(rect_from_json(rect_to_json(rect)), rect);
    for (const char* bad : {"[1, 2, 3]", "[1, 2, 3, 4, 5]", R"({"x0": 1})", "[0, 0, 4294967297, 1]",
                            "[0, 0, 1.5, 1]", "[-2147483648, 0, 2147483647, 1]", "[0, 0, 1, true]"})
        EXPECT_THROW(rect_from_json(nlohmann::json::parse(bad)), std::runtime_error) << bad;
}

// Copying and printing such a head would overflow the stack.
TEST(Message, AHeadOfBracketsIsRefused) {
    Message message = sample(MessageKind::progress, 0);
    message.head = nlohmann::json();
    std::vector<std::byte> bytes = pack(message);
    const std::string head = std::string(1000000, '[') + std::string(1000000, ']');
    bytes.resize(5 + head.size());
    for (std::size_t i = 0; i < 4; ++i)
        bytes[1 + i] = static_cast<std::byte>((head.size() >> (8 * i)) & 0xffU);
    std::transform(head.begin(), head.end(), bytes.begin() + 5,
                   [](char c) { return static_cast<std::byte>(c); });
    EXPECT_THROW(unpack(bytes, 0), std::runtime_error);
}

}  // namespace
}  // namespace mpipov
