#include "scene_pack.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
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

TEST(ScenePack, NamesAndSumsAreWhatTheySeem) {
    ScenePack pack = good();
    pack.files[0].name = "scene/caf\xe9";
    EXPECT_THAT(refusal(pack), HasSubstr("no UTF-8"));
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
    for (const json& value : {json(-1), json(1.5), json("1"), json()}) {
        json list = to_json(good());
        list["files"][0]["bytes"] = value;
        EXPECT_THROW(pack_from_json(list), std::runtime_error) << value;
    }
    json list = to_json(good());
    list["files"] = 7;
    EXPECT_THROW(pack_from_json(list), std::runtime_error);
    list = to_json(good());
    list["folders"] = {1, 2};
    EXPECT_THROW(pack_from_json(list), std::runtime_error);
}

}  // namespace
}  // namespace mpipov
