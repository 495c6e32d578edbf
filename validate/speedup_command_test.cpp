// `speedup` as a program, with the POV-Ray that is installed. Nothing is asked of the times.

#include "program_test.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <fstream>
#include <thread>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class SpeedupProgram : public ProgramTest {
  protected:
    SpeedupProgram() : ProgramTest({"speedup"}) {}

    json read() const {
        std::ifstream in(path("out/speedup.json"));
        return json::parse(in);
    }
    // The row of a variant; null where there is none.
    static json row(const json& found, const std::string& name) {
        for (const json& one : found.at("rows"))
            if (one.at("name") == name) return one;
        return {};
    }
    void program(const char* name, const std::string& script) const {
        std::ofstream(path(name)) << "#!/bin/sh\n" << script;
        fs::permissions(path(name), fs::perms::owner_all);
    }
    int measure(const std::vector<std::string>& more) {
        std::vector<std::string> arguments{scene("effects/none.pov"), "+W40", "+H30", "--out",
                                           "out"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    static std::string scene(const char* name) { return fmt::format("{}/{}", MPIPOV_SCENES, name); }
};

TEST_F(SpeedupProgram, MeasuresEachInTurns) {
    ASSERT_EQ(
        measure({"--ranks", "2,1,2", "--repeat", "2", "--schedule", "dynamic", "--dedicated"}), 0)
        << output_;
    const json found = read();
    EXPECT_EQ(found["format"], "mpipov-speedup");
    EXPECT_EQ(found["version"], 1);
    EXPECT_EQ(found["scene"], "none");
    EXPECT_EQ(found["image"]["width"], 40);
    EXPECT_TRUE(found["complete"].get<bool>());
    EXPECT_GE(found["host"]["cores"].get<int>(), 1);
    EXPECT_TRUE(found["versions"].contains("povray"));
    EXPECT_TRUE(found["versions"].contains("mpi"));

    std::vector<std::string> names;
    for (const json& one : found["rows"]) {
        names.push_back(one["name"]);
        EXPECT_EQ(one["times"].size(), 2U);
        for (const char* key : {"median_seconds", "low", "high", "speedup", "speedup_low",
                                "speedup_high", "efficiency"})
            EXPECT_GT(one[key].get<double>(), 0) << one["name"] << ' ' << key;
        EXPECT_LE(one["low"], one["median_seconds"]);
        EXPECT_LE(one["median_seconds"], one["high"]);
        EXPECT_TRUE(one["identical"].get<bool>()) << one["name"];
        EXPECT_TRUE(one["failure"].is_null());
    }
    EXPECT_THAT(names,
                ElementsAre("serial", "threads-1", "threads-2", "bands-1", "bands-2",
                            "mpipov-dynamic-1", "mpipov-dynamic-2", "mpipov-dynamic-dedicated-2"));
    EXPECT_EQ(found["rows"][0]["speedup"], 1);
    EXPECT_TRUE(
        fs::exists(path("out") / row(found, "mpipov-dynamic-2")["record"].get<std::string>()));

    ASSERT_EQ(found["repetitions"].size(), 2U);
    EXPECT_EQ(found["repetitions"][0]["order"], names);
    EXPECT_EQ(found["repetitions"][1]["order"][0], "bands-2");
    EXPECT_EQ(found["repetitions"][1]["seconds"]["bands-2"], row(found, "bands-2")["times"][1]);

    EXPECT_THAT(output_, HasSubstr("Speed-up against serial"));
    EXPECT_THAT(output_, HasSubstr("mpipov dynamic, dedicated coordinator"));
    EXPECT_THAT(output_, HasSubstr("All images that were made are the serial one bit for bit"));
}

TEST_F(SpeedupProgram, BandsMayBeOneRowHigh) {
    ASSERT_EQ(run({scene("effects/alpha.pov"), "+W24", "+H3", "-A", "+UA", "--out", "out",
                   "--ranks", "3", "--repeat", "1", "--schedule", "static"}),
              0)
        << output_;
    EXPECT_TRUE(row(read(), "bands-3")["identical"].get<bool>());
}

TEST_F(SpeedupProgram, OnlyTheRegionIsCutIntoBands) {
    ASSERT_EQ(
        run({scene("effects/none.pov"), "+W24", "+H20", "-A", "+SR6", "+ER15", "+SC5", "+EC20",
             "--out", "out", "--ranks", "3", "--repeat", "1", "--schedule", "static"}),
        0)
        << output_;
    EXPECT_TRUE(row(read(), "bands-3")["identical"].get<bool>());
}

TEST_F(SpeedupProgram, AFailingVariantIsARow) {
    program("broken-mpiexec", "echo 'no smoke without fire'; exit 7\n");
    EXPECT_EQ(measure({"--ranks", "1", "--repeat", "2", "--schedule", "static", "--mpiexec",
                       "./broken-mpiexec"}),
              3);
    const json found = read();
    EXPECT_TRUE(found["complete"].get<bool>());
    const json failed = row(found, "mpipov-static-1");
    EXPECT_THAT(failed["failure"].get<std::string>(), HasSubstr("smoke"));
    EXPECT_THAT(failed["times"], IsEmpty());
    EXPECT_TRUE(failed["speedup"].is_null());
    EXPECT_TRUE(failed["identical"].is_null());
    EXPECT_EQ(found["repetitions"][1]["order"].size(), 3U);  // it was not tried again
    EXPECT_EQ(row(found, "bands-1")["times"].size(), 2U);
    EXPECT_THAT(output_, HasSubstr("FAILED mpipov-static-1: "));
}

TEST_F(SpeedupProgram, MoreBandsThanRowsAreARow) {
    EXPECT_EQ(run({scene("effects/none.pov"), "+W24", "+H4", "--out", "out", "--ranks", "5",
                   "--repeat", "1", "--schedule", "static", "--mpiexec", "./none"}),
              2);
    const json found = read();
    EXPECT_THAT(row(found, "bands-5")["failure"].get<std::string>(), HasSubstr("4 rows"));
    EXPECT_THAT(row(found, "mpipov-static-5")["failure"].get<std::string>(), HasSubstr("./none"));
}

TEST_F(SpeedupProgram, OtherPixelsThanSerialAreToldAndNoSuccess) {
    program("painting-mpiexec",
            "mpiexec \"$@\" || exit\n"
            "for last; do :; done\n"
            "oiiotool --create 40x30 3 -d uint8 -o \"${last#+O}.png\"\n");
    EXPECT_EQ(measure({"--ranks", "1", "--repeat", "1", "--schedule", "static", "--mpiexec",
                       "./painting-mpiexec"}),
              1);
    const json painted = row(read(), "mpipov-static-1");
    EXPECT_FALSE(painted["identical"].get<bool>());
    EXPECT_GT(painted["differing"].get<int>(), 0);
    EXPECT_TRUE(painted["failure"].is_null());
    EXPECT_THAT(output_, HasSubstr("pixels differ"));
}

TEST_F(SpeedupProgram, WhatPovrayCannotRenderStopsAll) {
    std::ofstream(path("broken.pov")) << "sphere { nonsense }\n";
    EXPECT_EQ(run({"broken.pov", "+W32", "+H24", "--out", "out"}), 3);
    EXPECT_FALSE(read()["complete"].get<bool>());
    EXPECT_THAT(read()["failure"].get<std::string>(), HasSubstr("POV-Ray: "));
    EXPECT_EQ(measure({"--povray", "./none"}), 3);
    EXPECT_THAT(read()["failure"].get<std::string>(), HasSubstr("./none"));
}

TEST_F(SpeedupProgram, AnEarlierResultOutlivesARunThatMeasuredNothing) {
    ASSERT_EQ(measure({"--ranks", "1", "--repeat", "1", "--schedule", "static"}), 0) << output_;
    const json earlier = read();
    EXPECT_EQ(run({"none.pov", "+W32", "+H24", "--out", "out"}), 3);
    EXPECT_EQ(measure({"+Wide"}), 2) << output_;
    EXPECT_EQ(measure({"--povray", "./none"}), 3);
    EXPECT_EQ(read(), earlier);
    EXPECT_TRUE(fs::exists(path("out/mpipov-static-1.run.json")));
    EXPECT_EQ(measure({"--ranks", "2", "--repeat", "1", "--schedule", "static"}), 0) << output_;
    EXPECT_TRUE(row(read(), "mpipov-static-1").is_null());
}

TEST_F(SpeedupProgram, AnInterruptedRunKeepsWhatItHas) {
    program("slow-mpiexec", "touch started; sleep 60\n");
    ChildRequest request;
    request.argv = {MPIPOV_VALIDATE_PROGRAM,
                    "speedup",
                    scene("effects/none.pov"),
                    "+W40",
                    "+H30",
                    "--out",
                    "out",
                    "--ranks",
                    "1",
                    "--mpiexec",
                    "./slow-mpiexec"};
    request.working_directory = folder_.path();
    request.grace_seconds = 30;
    ChildProcess child = ChildProcess::start(request);
    while (!child.poll()) {
        if (fs::exists(path("started"))) child.terminate();
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_EQ(child.result().exit_code, 5) << child.output();
    const json found = read();
    EXPECT_FALSE(found["complete"].get<bool>());
    EXPECT_THAT(found["failure"].get<std::string>(), HasSubstr("interrupted"));
    EXPECT_EQ(row(found, "bands-1")["times"].size(), 1U);
    EXPECT_THAT(row(found, "mpipov-static-1")["times"], IsEmpty());
    EXPECT_THAT(std::string(child.output()), HasSubstr("NOT COMPLETE"));
}

TEST_F(SpeedupProgram, UsageErrors) {
    EXPECT_EQ(run({}), 2);
    EXPECT_THAT(output_, HasSubstr("no scene"));
    EXPECT_EQ(run({"scene.pov", "--nonsense"}), 2);
    EXPECT_EQ(run({"scene.pov", "--ranks", "0"}), 2);
    EXPECT_EQ(run({"scene.pov", "--ranks", "1,,2"}), 2);
    EXPECT_EQ(run({"scene.pov", "--repeat", "0"}), 2);
    EXPECT_EQ(run({"scene.pov", "--schedule", "static,sometimes"}), 2);
    EXPECT_THAT(output_, HasSubstr("'sometimes' is not one of static, dynamic, cost"));
    EXPECT_EQ(run({"scene.pov", "--slots", "1,2"}), 2);
    EXPECT_FALSE(fs::exists(path("speedup")));
    EXPECT_EQ(run({"--help"}), 0);
    for (const char* option : {"--ranks", "--repeat", "--schedule", "--dedicated", "--slots",
                               "--out", "--povray", "--mpiexec", "Exit code"})
        EXPECT_THAT(output_, HasSubstr(option));
}

}  // namespace
}  // namespace mpipov
