// Every member of every message's head as it must not be: negative, huge, a fraction, of another
// type, missing. Whoever gets it says so, and takes no memory for it.
#include "coordinator_test_support.h"
#include "event_loop.h"
#include "failure.h"
#include "in_process_transport.h"
#include "known_picture.h"
#include "meet_ranks.h"
#include "scratch.h"
#include "ship_scene.h"
#include "worker.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace mpipov {
namespace {

using nlohmann::json;

enum class Is {
    count,
    seconds,
    seconds_or_none,
    part,
    text,
    texts,
    said,
    all_said,
    flag,
    rect,
    code
};

const json empty = json::object(), list = json::array();

// What a member of that kind must not be. `good` is what it is.
std::vector<json> bad_values(Is is, const json& good) {
    const std::vector<json> numbers{-1,
                                    std::int64_t{1} << 31,
                                    std::int64_t{1} << 32,
                                    std::numeric_limits<std::uint64_t>::max(),
                                    std::numeric_limits<std::int64_t>::min(),
                                    1e300,
                                    "1",
                                    true,
                                    list,
                                    empty};
    switch (is) {
        case Is::count: {
            std::vector<json> bad = numbers;
            // Cut to an int it is the good one.
            bad.emplace_back(good.get<std::int64_t>() + (std::int64_t{1} << 32));
            bad.emplace_back(good.get<double>() + 0.5);
            bad.emplace_back(good.get<double>());
            bad.emplace_back(nullptr);
            return bad;
        }
        case Is::code:
            return {0, 1, 6, -1, 256, 258, 2.5, "2", true, nullptr, list, empty};
        case Is::seconds:
            return {-1, -1e-9, 1e300, "1", true, nullptr, list, empty};
        case Is::seconds_or_none:
            return {-1, 1e300, "1", true, list, empty};
        case Is::part:
            return {-0.1, 1.1, 1e300, "1", true, nullptr, list, empty};
        case Is::flag:
            return {0, 1, "true", nullptr, list, empty};
        case Is::said:
            return {1, true, nullptr, empty, {-1}, {256}, {list}};
        case Is::all_said:
            return {1, "a", true, nullptr, empty, {1}, {nullptr}, {empty}, {{256}}};
        case Is::text:
            return {1,     1.5, true,   nullptr, empty,   {-1},   {256},
                    {1.5}, {0}, {list}, {"a"},   {1, -1}, {true}, std::string("a\0b", 3)};
        case Is::texts:
            return {1,   "a",       true,    nullptr, empty,
                    {1}, {nullptr}, {empty}, {{256}}, {std::string("a\0b", 3)}};
        case Is::rect:
            return {list,
                    empty,
                    1,
                    "0 0 1 1",
                    nullptr,
                    {0, 0, 1},
                    {0, 0, 1, 1, 1},
                    {-1, 0, 1, 1},
                    {0, 0, 1.5, 1},
                    {0, 0, (std::int64_t{1} << 32) + 1, 1},
                    {0, 0, std::numeric_limits<int>::max(), std::numeric_limits<int>::max()}};
    }
    return {};
}

std::size_t peak_kib() {
    std::ifstream in("/proc/self/status");
    for (std::string line; std::getline(in, line);)
        if (line.starts_with("VmPeak:")) return std::stoul(line.substr(7));
    return 0;
}

// A fresh receiver gets the message each time.
struct Case {
    MessageKind kind;
    json head;
    std::map<std::string, Is> members;
    std::function<void(const Message&)> handle;
};

void give(const Case& c, const json& head, const std::string& what) {
    try {
        c.handle({c.kind, 1, head, {}});
        ADD_FAILURE() << "accepted: " << what;
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("[json.exception"))) << what;
    } catch (const std::exception& error) {
        ADD_FAILURE() << "of no exception of ours: " << what << ": " << error.what();
    }
}

void expect_refusals(const Case& c) {
    constexpr std::size_t most_kib = std::size_t{512} << 10;
    EXPECT_NO_THROW(c.handle({c.kind, 1, c.head, {}})) << "the good one";
    const std::size_t before = peak_kib();
    for (const auto& [key, is] : c.members) {
        for (const json& bad : bad_values(is, c.head.at(key))) {
            json head = c.head;
            head[key] = bad;
            give(c, head, fmt::format("{} = {}", key, bad.dump()));
        }
        json head = c.head;
        head.erase(key);
        give(c, head, "without " + key);
    }
    for (const json& head : {json(), json(1), json("x"), list, empty, json{1, 2}})
        if (!c.members.empty()) give(c, head, "the head " + head.dump());
    EXPECT_LT(peak_kib() - before, most_kib) << "memory was taken";
}

class HostileMessageTest : public testing::Test {
  protected:
    static json job() {
        return {{"povray", "povray"},
                {"user_arguments", {"+W64"}},
                {"format_arguments", {"+FN"}},
                {"threads", 1},
                {"block", 0},
                {"width", 64},
                {"height", 48},
                {"gathers", false},
                {"cache_bytes", 0},
                {"copy", "/nowhere"},
                {"folder", "scene"},
                {"ini", "povray.ini"},
                {"timeout_seconds", 30}};
    }
    static json look() {
        return {{"scene", "none.pov"},
                {"options", {"none.pov"}},
                {"library_paths", {"none"}},
                {"output", "none.png"},
                {"absolute", list}};
    }

    // To a worker that has these messages already.
    static std::function<void(const Message&)> to_worker(const std::vector<Message>& before) {
        return [before](const Message& message) {
            InProcessRanks ranks(2);
            const ScratchFolder scratch("hostile-message");
            Worker worker(ranks.at(1), scratch.path());
            for (const Message& one : before) worker.handle(one);
            worker.handle(message);
        };
    }
    // To the coordinator of two ranks, which have a section each.
    static std::function<void(const Message&)> to_coordinator(bool gathers = false) {
        return [gathers](const Message& message) {
            RigSetup setup;
            setup.grid = {{0, 0, 40, 10}, Shape::columns, Seams::aligned, 2, 0, 1};
            setup.gathers = gathers;
            Rig rig(setup);
            rig.coordinator().start();
            rig.coordinator().handle(message);
        };
    }
    // To the loop of a rank, which ends where the message is taken.
    static void to_loop(const Message& message, bool coordinates) {
        RigSetup setup;
        setup.grid = {{0, 0, 40, 10}, Shape::columns, Seams::aligned, 2, 0, 1};
        Rig rig(setup);
        InProcessRanks ranks(2);
        const int self = coordinates ? 0 : 1;
        Message sent = message;
        sent.peer = self;
        ranks.at(1 - self).send(sent);
        sent = {MessageKind::stop, self, empty, {}};
        ranks.at(1 - self).send(sent);
        const ScratchFolder scratch("hostile-message");
        Worker worker(ranks.at(self), scratch.path());
        run_event_loop({ranks.at(self), worker, coordinates ? &rig.coordinator() : nullptr});
    }
};

TEST_F(HostileMessageTest, Job) {
    expect_refusals({MessageKind::job,
                     job(),
                     {{"povray", Is::text},
                      {"user_arguments", Is::texts},
                      {"format_arguments", Is::texts},
                      {"threads", Is::count},
                      {"block", Is::count},
                      {"width", Is::count},
                      {"height", Is::count},
                      {"gathers", Is::flag},
                      {"copy", Is::text},
                      {"folder", Is::text},
                      {"ini", Is::text},
                      {"timeout_seconds", Is::seconds_or_none}},
                     to_worker({})});
    const Case size{MessageKind::job, job(), {}, to_worker({})};
    for (const json& bad : {json(-1), json(1.5), json(1e300), json("1"), json(true), json(),
                            json(std::numeric_limits<std::uint64_t>::max())}) {
        json head = job();
        head["cache_bytes"] = bad;
        give(size, head, "cache_bytes = " + bad.dump());
    }
    for (const char* member : {"folder", "ini"})
        for (const char* name : {"../scene", "/etc", "a/../../b"}) {
            json head = job();
            head[member] = name;
            give(size, head, fmt::format("{} = {}", member, name));
        }
}

TEST_F(HostileMessageTest, Assign) {
    json plain = job();
    plain["povray"] = "/bin/true";
    plain["copy"] = "";
    expect_refusals(
        {MessageKind::assign,
         {{"section", 3}, {"attempt", 1}, {"keep", {0, 0, 20, 10}}, {"render", {0, 0, 20, 10}}},
         {{"section", Is::count}, {"attempt", Is::count}, {"keep", Is::rect}, {"render", Is::rect}},
         to_worker({{MessageKind::job, 1, plain, {}}})});
}

TEST_F(HostileMessageTest, Cancel) {
    expect_refusals({MessageKind::cancel,
                     {{"section", 3}, {"attempt", 1}},
                     {{"section", Is::count}, {"attempt", Is::count}},
                     to_worker({{MessageKind::job, 1, job(), {}}})});
}

TEST_F(HostileMessageTest, Look) {
    expect_refusals({MessageKind::look,
                     look(),
                     {{"scene", Is::text},
                      {"options", Is::texts},
                      {"library_paths", Is::texts},
                      {"output", Is::text},
                      {"absolute", Is::texts}},
                     to_worker({})});
}

TEST_F(HostileMessageTest, Hello) {
    expect_refusals({MessageKind::hello,
                     {{"host", "h"}, {"slots", 1}, {"pool", 1}, {"povray", "3.7"}, {"view", "v"}},
                     {{"host", Is::text},
                      {"slots", Is::count},
                      {"pool", Is::count},
                      {"povray", Is::text},
                      {"view", Is::text}},
                     [](const Message& message) {
                         InProcessRanks ranks(2);
                         ranks.at(1).send({message.kind, 0, message.head, {}});
                         meet_ranks({0, "h0", 1, 0, 0}, 1, ranks.at(0), "3.7");
                     }});
}

TEST_F(HostileMessageTest, SpeakingOutOfTurnAtTheBeginning) {
    const json head{{"host", "h"}, {"slots", 1}, {"pool", 1}, {"povray", "3.7"}, {"view", "v"}};
    for (const MessageKind kind : {MessageKind::band, MessageKind::hello}) {
        InProcessRanks ranks(3);
        ranks.at(1).send({MessageKind::hello, 0, head, {}});
        ranks.at(1).send({kind, 0, head, {}});  // and rank 2 never does
        EXPECT_THROW(meet_ranks({0, "h0", 1, 0, 0}, 1, ranks.at(0), "3.7"), std::runtime_error);
    }
}

// What a rank answers to rank 0 that asks for the scene, and to the pack.
static std::function<void(const Message&)> to_ship(const std::vector<Message>& before) {
    return [before](const Message& message) {
        InProcessRanks ranks(2);
        for (Message one : before) {
            one.peer = 0;
            ranks.at(1).send(one);
        }
        ranks.at(1).send({message.kind, 0, message.head, {}});
        ShipRequest request;
        request.ship = before.empty() ? Ship::automatic : Ship::on;
        request.ranks = {{"h0", "v0"}, {"h1", "v1"}};
        request.patience_seconds = 1;
        ship_scene(request, ranks.at(0));
    };
}

TEST_F(HostileMessageTest, Seen) {
    const json ini = to_json(view_scene({})).at("ini");
    expect_refusals(
        {MessageKind::seen, {{"files", list}, {"ini", ini}}, {{"ini", Is::text}}, to_ship({})});
    const Case files{MessageKind::seen, {{"files", list}, {"ini", ini}}, {}, to_ship({})};
    const std::vector<json> bad{1,
                                "a",
                                true,
                                nullptr,
                                empty,
                                {1},
                                {list},
                                {empty},
                                {{{"name", "a"}}},
                                {{{"name", 1}, {"sha1", ""}}},
                                {{{"name", "a"}, {"sha1", 1}}}};
    for (const json& value : bad) give(files, {{"files", value}, {"ini", ini}}, value.dump());
    give(files, {{"ini", ini}}, "without files");
}

TEST_F(HostileMessageTest, Unpacked) {
    expect_refusals({MessageKind::unpacked,
                     {{"folder", "/tmp/copy"}},
                     {{"folder", Is::text}},
                     to_ship({{MessageKind::seen, 1, {{"files", list}, {"ini", ""}}, {}}})});
}

TEST_F(HostileMessageTest, Progress) {
    expect_refusals({MessageKind::progress,
                     {{"section", 1}, {"attempt", 1}, {"fraction", 0.5}},
                     {{"section", Is::count}, {"attempt", Is::count}, {"fraction", Is::part}},
                     to_coordinator()});
}

TEST_F(HostileMessageTest, Samples) {
    expect_refusals({MessageKind::samples,
                     {{"section", 1}, {"attempt", 1}},
                     {{"section", Is::count}, {"attempt", Is::count}},
                     to_coordinator(true)});
}

TEST_F(HostileMessageTest, Done) {
    expect_refusals({MessageKind::done,
                     {{"section", 1},
                      {"attempt", 1},
                      {"wall_seconds", 1.5},
                      {"cpu_seconds", 1},
                      {"warnings", {"one"}}},
                     {{"section", Is::count},
                      {"attempt", Is::count},
                      {"wall_seconds", Is::seconds},
                      {"cpu_seconds", Is::seconds},
                      {"warnings", Is::all_said}},
                     to_coordinator(true)});
}

TEST_F(HostileMessageTest, Failed) {
    const json head{{"section", 1}, {"attempt", 1}, {"cpu_seconds", 1}, {"code", 4}, {"why", "x"}};
    expect_refusals({MessageKind::failed,
                     head,
                     {{"section", Is::count},
                      {"attempt", Is::count},
                      {"cpu_seconds", Is::seconds},
                      {"code", Is::code},
                      {"why", Is::said}},
                     to_coordinator()});
}

TEST_F(HostileMessageTest, Alive) {
    expect_refusals({MessageKind::alive,
                     {{"again_within", 15}},
                     {{"again_within", Is::seconds_or_none}},
                     [](const Message& message) { to_loop(message, false); }});
}

// Each ends the run; but not with 0, and not with a number that means nothing.
TEST_F(HostileMessageTest, Refused) {
    const json good{{"host", "h"}, {"why", "no"}, {"code", 4}};
    const auto ends = [](const json& head) {
        try {
            to_loop({MessageKind::refused, 1, head, {}}, true);
            ADD_FAILURE() << "accepted: " << head;
        } catch (const Failure& failure) {
            return static_cast<int>(failure.code());
        } catch (const std::runtime_error&) {
            return -1;
        }
        return -2;
    };
    EXPECT_EQ(ends(good), 4);
    for (const json& bad : bad_values(Is::code, {})) {
        json head = good;
        head["code"] = bad;
        EXPECT_EQ(ends(head), -1) << head;
    }
    for (const char* member : {"why", "code"}) {
        json head = good;
        head.erase(member);
        EXPECT_EQ(ends(head), -1) << head;
    }
}

}  // namespace
}  // namespace mpipov
