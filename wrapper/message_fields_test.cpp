#include "message_fields.h"

#include "message.h"
#include "scene_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace mpipov {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::ThrowsMessage;

// As on the way between ranks.
json sent(const json& head) {
    Message message;
    message.head = head;
    return unpack(pack(message), 0).head;
}

TEST(MessageFields, ReadWhatIsRight) {
    const json head{{"number", 7}, {"size", 1LL << 40}, {"seconds", 1.5}, {"none", nullptr},
                    {"part", 1},   {"flag", true},      {"code", 4},      {"rect", {0, 1, 2, 3}},
                    {"text", "a"}, {"texts", {"a", ""}}};
    const json there = sent(head);
    const MessageFields fields(there);
    EXPECT_EQ(fields.number("number", 7, 7), 7);
    EXPECT_EQ(fields.size("size", 1ULL << 40), 1ULL << 40);
    EXPECT_EQ(fields.seconds("seconds"), 1.5);
    EXPECT_EQ(fields.seconds_or_none("none"), std::nullopt);
    EXPECT_EQ(fields.part("part"), 1);
    EXPECT_TRUE(fields.flag("flag"));
    EXPECT_EQ(fields.code("code"), Exit::file);
    EXPECT_EQ(fields.rect("rect"), (Rect{0, 1, 2, 3}));
    EXPECT_EQ(fields.text("text"), "a");
    EXPECT_THAT(fields.texts("texts"), testing::ElementsAre("a", ""));
}

TEST(MessageFields, WhatIsWrongIsNamed) {
    const json head{{"section", 1LL << 32}, {"why", 3}};
    EXPECT_THAT([&] { MessageFields(head).number("section", 0, 9); },
                ThrowsMessage<std::runtime_error>(HasSubstr("'section': is out of range")));
    EXPECT_THAT([&] { MessageFields(head).text("why"); },
                ThrowsMessage<std::runtime_error>(HasSubstr("'why': is no text")));
    EXPECT_THAT([&] { MessageFields(head).text("host"); },
                ThrowsMessage<std::runtime_error>(HasSubstr("it lacks 'host'")));
}

TEST(MessageFields, AZeroByteIsForWordsAlone) {
    const std::string zero("a\0b", 3);
    const json head = sent({{"one", zero}, {"all", {zero}}});
    EXPECT_THROW(MessageFields(head).text("one"), std::runtime_error);
    EXPECT_THROW(MessageFields(head).texts("all"), std::runtime_error);
    EXPECT_EQ(MessageFields(head).said("one"), zero);
    EXPECT_THAT(MessageFields(head).all_said("all"), testing::ElementsAre(zero));
}

// JSON would replace them.
TEST(MessageFields, TextThatIsNoUtf8ArrivesAsItWas) {
    const std::vector<std::string> odd{"caf\xe9", "\xff\xfe", "\xc3", "schön", "", "[1]", "\x01"};
    const json head = sent({{"texts", texts_to_json(odd)}, {"one", text_to_json(odd[0])}});
    EXPECT_EQ(MessageFields(head).texts("texts"), odd);
    EXPECT_EQ(MessageFields(head).text("one"), odd[0]);
}

TEST(MessageFields, WhatARankIsAskedForAndSeesArrivesAsItWas) {
    const SceneRequest request{"caf\xe9.pov", {"+Ll\xe9"}, {"l\xe9"}, "\xe9.png"};
    const SceneRequest there = scene_request_from_json(sent(to_json(request)));
    EXPECT_EQ(there.scene, request.scene);
    EXPECT_EQ(there.options, request.options);
    EXPECT_EQ(there.library_paths, request.library_paths);
    EXPECT_EQ(there.output, request.output);
    const SceneView view{{{"caf\xe9.pov", "sum"}}, "ini"};
    EXPECT_EQ(difference(scene_view_from_json(sent(to_json(view))), view), "");
}

}  // namespace
}  // namespace mpipov
