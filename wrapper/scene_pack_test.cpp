#include "scene_pack.h"

#include "message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <span>
#include <stdexcept>

namespace mpipov {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::string digits(40, 'a');

ScenePack good() {
    return {{{"scene/job/a.pov", 10, digits},
             {"scene/lib/b.inc", 0, digits},
             {"povray.ini", 5, digits}},
            {"scene/job", "scene/empty"},
            "scene/job",
            "povray.ini"};
}

std::string refusal(const ScenePack& pack, const PackLimits& limits = {}) {
    try {
        check(pack, limits);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

TEST(ScenePack, AGoodOneIsTakenAndSurvivesTheWay) {
    EXPECT_EQ(refusal(good()), "");
    const ScenePack back = pack_from_json(to_json(good()));
    EXPECT_EQ(to_json(back), to_json(good()));
    EXPECT_EQ(bytes_of(back), 15U);
}

TEST(ScenePack, NamesStayInside) {
    for (const char* name : {"a", "a/b.c", "...", "a/..b", "..a", " ", "-a", "--", "a\nb", "a\\b"})
        EXPECT_TRUE(stays_inside(name)) << name;
    for (const char* name : {"", "/", "/etc/passwd", "..", "../a", "a/..", "a/../../b", ".", "./a",
                             "a/./b", "a//b", "a/", "//a"})
        EXPECT_FALSE(stays_inside(name)) << name;
    EXPECT_FALSE(stays_inside(std::string_view("a\0b", 3)));
}

TEST(ScenePack, NamesThatLeadOutAreRefused) {
    for (const char* name : {"/etc/cron.d/a", "../a", "scene/../../a", "scene//a", ""}) {
        ScenePack pack = good();
        pack.files[0].name = name;
        EXPECT_THAT(refusal(pack), HasSubstr("could lead out")) << name;
        pack = good();
        pack.folders[1] = name;
        EXPECT_THAT(refusal(pack), HasSubstr("could lead out")) << name;
    }
}

TEST(ScenePack, WhereItRunsAndItsIniAreOfThePack) {
    ScenePack pack = good();
    pack.folder = "/etc";
    EXPECT_THAT(refusal(pack), HasSubstr("folder to run in"));
    pack = good();
    pack.ini = "../povray.ini";
    EXPECT_THAT(refusal(pack), HasSubstr("povray.ini"));
    pack = good();
    pack.folder = "scene";  // that of another one
    EXPECT_EQ(refusal(pack), "");
}

TEST(ScenePack, AFileIsNoFolderAndComesOnce) {
    ScenePack pack = good();
    pack.files.push_back(pack.files[0]);
    EXPECT_THAT(refusal(pack), HasSubstr("'scene/job/a.pov' comes twice"));
    pack = good();
    pack.files.push_back({"scene/job/a.pov/b", 1, digits});
    EXPECT_THAT(refusal(pack), HasSubstr("'scene/job/a.pov' is a file and a folder"));
    pack = good();
    pack.folders.emplace_back("povray.ini");
    EXPECT_THAT(refusal(pack), HasSubstr("a file and a folder"));
}

TEST(ScenePack, BombsAreRefusedAndTheLimitIsNamed) {
    PackLimits limits;
    limits.names = 4;
    EXPECT_THAT(refusal(good(), limits), HasSubstr("5 files and folders, and the limit is 4"));
    limits = {};
    limits.bytes = 14;
    EXPECT_THAT(refusal(good(), limits), HasSubstr("more than 14 bytes"));
    limits.bytes = 15;
    EXPECT_EQ(refusal(good(), limits), "");
    limits = {};
    limits.name_bytes = 14;
    EXPECT_THAT(refusal(good(), limits), HasSubstr("15 bytes, and the limit is 14"));
    limits = {};
    limits.all_name_bytes = 30;
    EXPECT_THAT(refusal(good(), limits), HasSubstr("and the limit is 30"));
    ScenePack pack = good();  // a sum that overflows
    pack.files[0].bytes = std::numeric_limits<std::uint64_t>::max();
    pack.files[1].bytes = 2;
    EXPECT_THAT(refusal(pack), HasSubstr("which is the limit"));
}

// A few thousand long names of their own folders: each is within its limits.
TEST(ScenePack, FoldersThatAreOnlyImpliedCount) {
    PackLimits limits;
    ScenePack pack = good();
    limits.names = 7;  // scene, scene/empty, scene/job, scene/lib and three files
    EXPECT_EQ(refusal(pack, limits), "");
    limits.names = 6;
    EXPECT_THAT(refusal(pack, limits), HasSubstr("7 files and folders, and the limit is 6"));
    for (int i = 0; i < 4000; ++i) {
        std::string name = std::to_string(i);
        while (name.size() + 2 < limits.name_bytes) name += "/a";
        pack.files.push_back({name, 0, digits});
    }
    EXPECT_THAT(refusal(pack), HasSubstr("files and folders, and the limit is 20000"));
}

TEST(ScenePack, NamesThatOnlyLookLikeFoldersAreNone) {
    ScenePack pack = good();
    for (const char* name : {"scene/job/a", "scene/job/a.", "scene/job/a.pov-", "scene/job/a.pov0",
                             "scene/job/A.pov", "scene-"})
        pack.files.push_back({name, 1, digits});
    EXPECT_EQ(refusal(pack), "");
    // Whichever comes first, and whatever sorts between them.
    pack.files.insert(pack.files.begin(), {"scene/job/a/b", 1, digits});
    EXPECT_THAT(refusal(pack), HasSubstr("'scene/job/a' is a file and a folder"));
    pack = good();
    pack.files.push_back({"scene/empty", 1, digits});
    EXPECT_THAT(refusal(pack), HasSubstr("'scene/empty' is a file and a folder"));
}

TEST(ScenePack, AnEmptyOneIsRefused) {
    EXPECT_THAT(refusal({}), HasSubstr("lacks the folder to run in"));
    EXPECT_THAT(refusal({{}, {"scene"}, "scene", ""}), HasSubstr("lacks its povray.ini"));
    EXPECT_THAT(refusal({{}, {""}, "", ""}), HasSubstr("could lead out"));
    for (const char* ini : {"scene/job/", "scene/job", "scene/empty/", ""}) {
        ScenePack pack = good();
        pack.ini = ini;
        EXPECT_THAT(refusal(pack), HasSubstr("lacks its povray.ini")) << ini;
    }
    for (const char* folder : {"", "/", "scene/", "scene/job/a.pov", "scene/jo", "."}) {
        ScenePack pack = good();
        pack.folder = folder;
        EXPECT_THAT(refusal(pack), HasSubstr("lacks the folder to run in")) << folder;
    }
}

TEST(ScenePack, OddNamesAreRefused) {
    for (const std::string& name :
         {std::string("scene/a\nb"), std::string("scene/a\x1b[2Jb"), std::string("scene/a\x7f"),
          std::string("scene/a\0b", 9), std::string(5000, 'a')}) {
        ScenePack pack = good();
        pack.files[0].name = name;
        EXPECT_NE(refusal(pack), "") << name.substr(0, 20);
        pack = good();
        pack.folders[1] = name;
        EXPECT_NE(refusal(pack), "") << name.substr(0, 20);
    }
}

TEST(ScenePack, AMillionEntriesAreRefused) {
    ScenePack pack = good();
    for (int i = 0; i < 1'000'000; ++i) pack.folders.push_back(std::to_string(i));
    EXPECT_THAT(refusal(pack), HasSubstr("1000005 files and folders, and the limit is 20000"));
}

TEST(ScenePack, NamesThatAreNoUtf8AreTakenAsTheyAre) {
    ScenePack pack = good();
    pack.files[0].name = "scene/job/caf\xe9";
    pack.folder = pack.folders[0] = "scene/job/d\xe9r";
    const ScenePack back = pack_from_json(json::parse(to_json(pack).dump()));
    EXPECT_EQ(refusal(back), "");
    EXPECT_EQ(back.files[0].name, pack.files[0].name);
    EXPECT_EQ(back.folders, pack.folders);
    EXPECT_EQ(back.folder, pack.folder);
}

TEST(ScenePack, SumsAreWhatTheySeem) {
    ScenePack pack = good();
    for (const char* sha1 : {"", "A", "../a"}) {
        pack = good();
        pack.files[0].sha1 = sha1;
        EXPECT_THAT(refusal(pack), HasSubstr("no SHA-1")) << sha1;
    }
}

// Nothing but names, sizes and sums: no links, devices, owners or modes.
TEST(ScenePack, WhatAPackDoesNotHoldIsRefused) {
    for (const char* member : {"link", "type", "device", "mode"}) {
        json list = to_json(good());
        list["files"][0][member] = "/etc/passwd";
        EXPECT_THROW(pack_from_json(list), std::runtime_error) << member;
        list = to_json(good());
        list[member] = 1;
        EXPECT_THROW(pack_from_json(list), std::runtime_error) << member;
    }
}

TEST(ScenePack, ADamagedListIsRefused) {
    for (const json& list : {json(), json(3), json::array(), json::object()})
        EXPECT_THROW(pack_from_json(list), std::runtime_error) << list;
    for (const json& value : {json(-1), json(1.5), json("1"), json(), json(true), json(1e300),
                              json(std::numeric_limits<std::uint64_t>::max())}) {
        json list = to_json(good());
        list["files"][0]["bytes"] = value;
        EXPECT_THROW(pack_from_json(list), std::runtime_error) << value;
    }
    json list = to_json(good());
    list["files"] = 7;
    EXPECT_THROW(pack_from_json(list), std::runtime_error);
    for (const char* key : {"files", "folders", "folder", "ini"}) {
        for (const json& value : {json(), json(1), json(true), json::object(), json{1, 1000},
                                  json{nullptr}, json{json::object()}}) {
            list = to_json(good());
            list[key] = value;
            EXPECT_THROW(pack_from_json(list), std::runtime_error) << key << " = " << value;
        }
        list = to_json(good());
        list.erase(key);
        EXPECT_THROW(pack_from_json(list), std::runtime_error) << "without " << key;
    }
    for (const char* key : {"name", "bytes", "sha1"}) {
        list = to_json(good());
        list["files"][0].erase(key);
        EXPECT_THROW(pack_from_json(list), std::runtime_error) << "without " << key;
    }
}

TEST(ScenePack, AListThatIsCutAnywhereIsRefused) {
    Message message;
    message.kind = MessageKind::pack;
    message.head = to_json(good());
    const std::vector<std::byte> whole = pack(message);
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_THROW(unpack(std::span(whole).first(size), 0), std::runtime_error) << size;
    EXPECT_EQ(unpack(whole, 0).head, message.head);
}

}  // namespace
}  // namespace mpipov
