// Messages that the protocol does not allow: an exception each, and no pixel of them on the canvas.
#include "coordinator_test_support.h"
#include "failure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

namespace mpipov {
namespace {

constexpr Rect frame{0, 0, 40, 10};

// Four columns of 10 pixels, the first two under way: section 0 on rank 0, section 1 on rank 1.
class ProtocolTest : public testing::Test {
  protected:
    ProtocolTest() : rig_(setup()) { rig_.coordinator().start(); }

    static RigSetup setup() {
        RigSetup setup;
        setup.grid = {frame, Shape::columns, Seams::halo, 4, 2, 32};
        return setup;
    }

    static Message message(MessageKind kind, int rank, int section, nlohmann::json head,
                           std::size_t bytes = 0, int attempt = 1) {
        head["section"] = section;
        head["attempt"] = attempt;
        return {kind, rank, std::move(head), std::vector<std::byte>(bytes, std::byte{0xee})};
    }
    static Message band(int rank, int section, const Rect& rect, int attempt = 1) {
        return message(MessageKind::band, rank, section, {{"rect", rect_to_json(rect)}},
                       static_cast<std::size_t>(rect.area()) * known_channels, attempt);
    }
    static Message done(int rank, int section, int attempt = 1) {
        return message(
            MessageKind::done, rank, section,
            {{"wall_seconds", 1.0}, {"cpu_seconds", 1.0}, {"warnings", nlohmann::json::array()}}, 0,
            attempt);
    }

    void refused(const Message& m, const std::string& why) {
        const std::string before = rig_.canvas().sha1();
        try {
            rig_.coordinator().handle(m);
            ADD_FAILURE() << "accepted: " << why;
        } catch (const std::runtime_error& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr(why));
        }
        EXPECT_EQ(rig_.canvas().sha1(), before) << "it was written: " << why;
    }

    void handle(const Message& m) { rig_.coordinator().handle(m); }

    Rig rig_;
};

// What section 1 renders, and bands of it.
constexpr Rect render{8, 0, 22, 10};

TEST_F(ProtocolTest, TakesWhatIsRight) {
    handle(band(1, 1, {8, 0, 22, 4}));
    handle(band(1, 1, {8, 4, 22, 10}));
    handle(done(1, 1));
    EXPECT_EQ(rig_.coordinator().sections_done(), 1);
    EXPECT_EQ(rig_.canvas().read({10, 9, 11, 10}).front(), std::byte{0xee});
    EXPECT_EQ(rig_.canvas().read({9, 9, 10, 10}).front(), std::byte{0}) << "the halo is not kept";
}

TEST_F(ProtocolTest, RefusesUnknownSections) {
    for (const int id : {4, 1'000'000}) refused(band(1, id, render), "unknown section");
    refused(band(1, -1, render), "'section': must be from 0");
}

TEST_F(ProtocolTest, RefusesAnothersSection) {
    refused(band(0, 1, render), "was not given");
    refused(band(1, 0, {0, 0, 12, 10}), "was not given");
    refused(band(1, 3, {28, 0, 40, 10}), "was not given");
    refused(done(0, 1), "was not given");
    refused(message(MessageKind::failed, 0, 1, {{"why", "no"}, {"code", 3}, {"cpu_seconds", 0}}),
            "was not given");
    refused(message(MessageKind::progress, 0, 1, {{"fraction", 0.5}}), "was not given");
}

TEST_F(ProtocolTest, RefusesOtherAttempts) {
    refused(band(1, 1, render, 2), "was not given");
    refused(band(1, 1, render, 0), "was not given");
}

TEST_F(ProtocolTest, RefusesAnAttemptThatHasFailed) {
    // Rank 0 takes section 2 when it is free, and the failed section 1 after that.
    handle(message(MessageKind::failed, 1, 1, {{"why", "no"}, {"code", 3}, {"cpu_seconds", 0}}));
    refused(band(1, 1, render), "was not given");
    handle(band(0, 0, {0, 0, 12, 10}));
    handle(done(0, 0));
    handle(band(0, 1, {8, 0, 22, 5}, 2));
    refused(band(1, 1, render), "was not given");
    refused(band(0, 1, {8, 5, 22, 10}, 1), "was not given");
}

TEST_F(ProtocolTest, RefusesWhatFollowsDone) {
    handle(band(1, 1, render));
    handle(done(1, 1));
    refused(band(1, 1, render), "was not given");
    refused(done(1, 1), "was not given");
}

TEST_F(ProtocolTest, RefusesPixelsOutsideOfTheSection) {
    constexpr int most = std::numeric_limits<int>::max();
    for (const Rect& rect : {Rect{7, 0, 22, 10}, Rect{8, 0, 23, 10}, Rect{8, 0, 22, 11},
                             Rect{30, 0, 40, 10}, Rect{22, 10, 8, 0}, Rect{8, 0, 22, 0}})
        refused(band(1, 1, rect), "outside of section 1");
    refused(message(MessageKind::band, 1, 1, {{"rect", rect_to_json({8, 0, most, most})}}, 30),
            "outside of section 1");
    for (const Rect& rect : {Rect{8, -1, 22, 10}, Rect{-most, -most, 22, 10}})
        refused(message(MessageKind::band, 1, 1, {{"rect", rect_to_json(rect)}}, 30),
                "negative edge");
}

TEST_F(ProtocolTest, RefusesOtherRowsThanTheNext) {
    refused(band(1, 1, {8, 1, 22, 10}), "other rows");
    refused(band(1, 1, {10, 0, 20, 10}), "other rows");
    handle(band(1, 1, {8, 0, 22, 5}));
    refused(band(1, 1, {8, 0, 22, 5}), "other rows");
    refused(band(1, 1, {8, 6, 22, 10}), "other rows");
    refused(band(1, 1, {8, 5, 21, 10}), "other rows");
}

TEST_F(ProtocolTest, RefusesTooFewOrTooManyBytes) {
    const auto whole = static_cast<std::size_t>(render.area()) * known_channels;
    for (const std::size_t bytes :
         {std::size_t{0}, std::size_t{1}, whole - 1, whole + 1, 2 * whole})
        refused(message(MessageKind::band, 1, 1, {{"rect", rect_to_json(render)}}, bytes), "bytes");
}

TEST_F(ProtocolTest, RefusesAnEndBeforeTheLastRow) {
    refused(done(1, 1), "without all of its rows");
    handle(band(1, 1, {8, 0, 22, 9}));
    refused(done(1, 1), "without all of its rows");
    EXPECT_EQ(rig_.coordinator().sections_done(), 0);
}

TEST_F(ProtocolTest, RefusesWhatIsNotForTheCoordinator) {
    for (const MessageKind kind : {MessageKind::hello, MessageKind::job, MessageKind::assign,
                                   MessageKind::stop, MessageKind::bye})
        refused(message(kind, 1, 1, {}), "not for it");
}

TEST_F(ProtocolTest, RefusesHeadsThatLackSomething) {
    const auto handled = [&](MessageKind kind, const nlohmann::json& head) {
        rig_.coordinator().handle({kind, 1, head, {}});
    };
    EXPECT_THROW(handled(MessageKind::band, nlohmann::json::object()), std::exception);
    EXPECT_THROW(handled(MessageKind::band, {{"section", 1}, {"attempt", 1}}), std::exception);
    EXPECT_THROW(handled(MessageKind::band, {{"section", "1"}, {"attempt", 1}}), std::exception);
    EXPECT_THROW(handled(MessageKind::band, {{"section", 1}, {"attempt", 1}, {"rect", {1, 2}}}),
                 std::exception);
    EXPECT_THROW(handled(MessageKind::progress, {{"section", 1}, {"attempt", 1}}), std::exception);
    EXPECT_THROW(handled(MessageKind::failed, {{"section", 1}, {"attempt", 1}}), std::exception);
}

}  // namespace
}  // namespace mpipov
