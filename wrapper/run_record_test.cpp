#include "run_record.h"

#include "scratch.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <limits>
#include <string>

namespace mpipov {
namespace {

RunRecord sample_record() {
    RunRecord r;
    r.complete = true;
    r.versions = {{"mpipov", "0.1.0"}, {"povray", "3.7.0.10"}};
    r.command = {"mpipov", "scene.pov", "+W64"};
    r.started = "2026-01-01T00:00:00Z";
    r.output = "out dir/scene.png";
    r.pixel_sha1 = "da39a3ee5e6b4b0d3255bfef95601890afd80709";
    r.plan.image = {64, 48, 3, "png", "uint8"};
    r.plan.region = {0, 0, 64, 48};
    r.plan.effects["radiosity"] = {true, "Radiosity Time", 1.5};
    r.plan.effects["photons"] = {false, "No photons", {}};
    r.plan.shape = Shape::tiles;
    r.plan.seams = Seams::halo;
    r.plan.halo = 2;
    r.plan.sections = 2;
    r.plan.schedule = "dynamic";
    r.plan.predicted = {1.25, 2.5};
    r.ranks = {{0, "n1", 2, 2, 3.5}};
    r.sections = {{{0, {0, 0, 32, 48}, {0, 0, 34, 48}}, 0, "n1", 0.5, 1.5, 1.0, 0.9, 2, false}};
    r.plan.radiosity = {Sharing::shared, 2, 3};
    r.waves = {{21, 16, 77, r.sections}};
    r.seams = {{{0, 1, true, 32, 0, 48}, true, 3, 7.0, 4}};
    r.repairs = {{{2, {31, 0, 33, 48}, {27, 0, 37, 48}}, 1, "n2", 1.5, 2.5, 1.0, 0.9, 1, false}};
    r.totals = {2.0, 3.0, 0.01, 5, 1};
    r.warnings = {"Parse Warning: x"};
    return r;
}

TEST(RunRecord, SurvivesTheRoundTrip) {
    const nlohmann::json json = to_json(sample_record());
    EXPECT_EQ(to_json(run_from_json(json)), json);
}

// Two sections of an EXR may disagree by it; JSON knows no such number.
TEST(RunRecord, AnInfiniteDifferenceIsReadBack) {
    const ScratchFolder scratch("record-test");
    const std::filesystem::path file = scratch.path() / "run.json";
    RunRecord record = sample_record();
    record.seams[0].max_difference = std::numeric_limits<double>::infinity();
    write_run_record(file, record);
    EXPECT_EQ(read_run_record(file).seams.at(0).max_difference, record.seams[0].max_difference);
    EXPECT_EQ(to_json(read_run_record(file)), to_json(record));
}

TEST(RunRecord, IsWrittenAsAWholeUnderAnyNameOrNotAtAll) {
    const ScratchFolder scratch("record-test");
    const std::filesystem::path file = scratch.path() / (std::string(250, 'r') + ".json");
    write_run_record(file, sample_record());
    EXPECT_EQ(to_json(read_run_record(file)), to_json(sample_record()));
    const std::filesystem::path in_the_way = scratch.path() / "folder";
    std::filesystem::create_directories(in_the_way / "inside");
    EXPECT_THROW(write_run_record(in_the_way, sample_record()), std::runtime_error);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(scratch.path()), {}), 2);
}

TEST(RunRecord, ReadsRecordsOfVersionsThatSharedNoRadiosity) {
    nlohmann::json json = to_json(sample_record());
    json.erase("waves");
    json["plan"].erase("radiosity");
    const RunRecord record = run_from_json(json);
    EXPECT_EQ(record.plan.radiosity, RadiositySharing());
    EXPECT_TRUE(record.waves.empty());
}

TEST(RunRecord, NamesWhatIsMissing) {
    nlohmann::json json = to_json(sample_record());
    json["plan"].erase("grid");
    try {
        run_from_json(json);
        FAIL() << "accepted a record without a grid";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("grid"), std::string::npos) << error.what();
    }
}

TEST(RunRecord, NamesWhatIsOfAnotherKind) {
    nlohmann::json json = to_json(sample_record());
    json["totals"]["launches"] = "many";
    try {
        run_from_json(json);
        FAIL() << "accepted words for a number";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "its 'launches': must be a whole number, but is string");
    }
}

TEST(RunRecord, WhatIsNoJsonIsToldWithoutTheLibrarysIds) {
    const ScratchFolder scratch("record-test");
    const std::filesystem::path file = scratch.path() / "run.json";
    std::ofstream(file) << "{";
    try {
        read_run_record(file);
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::string(error.what()).find("json.exception"), std::string::npos)
            << error.what();
    }
}

TEST(RunRecord, RefusesAnotherFormatAndTextThatIsNoJson) {
    EXPECT_THROW(run_from_json({{"format", "else"}, {"version", 1}}), std::runtime_error);
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / "mpipov-record-test.json";
    std::ofstream(file) << "{";
    EXPECT_THROW(read_run_record(file), std::runtime_error);
    std::filesystem::remove(file);
    EXPECT_THROW(read_run_record(file), std::runtime_error);
}

TEST(RunRecord, RefusesNumbersThatNoRunHas) {
    const auto refused = [](const char* where, const nlohmann::json& value) {
        nlohmann::json json = to_json(sample_record());
        json[nlohmann::json::json_pointer(where)] = value;
        EXPECT_THROW(run_from_json(json), std::runtime_error) << where << " " << value;
    };
    // Both are divided by.
    refused("/plan/grid/block", 0);
    refused("/plan/radiosity/scale", 0);
    refused("/plan/radiosity/passes", 0);
    refused("/plan/grid/sections", 0);
    refused("/plan/image/width", 4294967296 + 320);
    refused("/plan/image/width", 320.5);
    // Its width would overflow.
    refused("/plan/region/x0", std::numeric_limits<int>::min());
    refused("/sections/0/keep/x0", -1);
    refused("/seams/0/position", -1);
}

}  // namespace
}  // namespace mpipov
