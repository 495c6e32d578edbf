// `tradeoff` as a program, with the POV-Ray that is installed, on small pictures.

#include "program_test.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

class TradeoffProgram : public ProgramTest {
  protected:
    TradeoffProgram() : ProgramTest({"tradeoff"}) {
        // Each render of this POV-Ray leaves a line: --allow-write.
        std::ofstream(path("counting-povray"))
            << "#!/bin/sh\necho \"$@\" >> renders\nexec povray \"$@\"\n";
        fs::permissions(path("counting-povray"), fs::perms::owner_all);
    }

    json read() const {
        std::ifstream in(path("out/tradeoff.json"));
        return json::parse(in);
    }
    static json row(const json& found, const std::string& name) {
        for (const json& one : found.at("rows"))
            if (one.at("name") == name) return one;
        return {};
    }
    static std::string scene(const char* name) { return fmt::format("{}/{}", MPIPOV_SCENES, name); }

    static std::vector<std::string> arguments(const std::vector<std::string>& more,
                                              const char* repeat = "1") {
        std::vector<std::string> arguments{scene("effects/reflection.pov"),
                                           "+W40",
                                           "+H30",
                                           "--out",
                                           "out",
                                           "--repeat",
                                           repeat,
                                           "--truth-samples",
                                           "164"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }
    static std::vector<std::string> counted(const std::vector<std::string>& more,
                                            const char* repeat = "1") {
        std::vector<std::string> all{
            "--sweep",  "antialiasing",      "--methods",    "1",   "--depths",      "2",
            "--povray", "./counting-povray", "--thresholds", "0.3", "--allow-write", "."};
        all.insert(all.end(), more.begin(), more.end());
        return arguments(all, repeat);
    }
    // Renders of that name since the last call, but for those of the probe.
    int renders() {
        std::ifstream in(path("renders"));
        int count = 0;
        for (std::string line; std::getline(in, line);)
            if (line.find("serial-") != std::string::npos) ++count;
        in.close();
        fs::remove(path("renders"));
        return count;
    }
};

TEST_F(TradeoffProgram, SweepsTheAntialiasingAndPicks) {
    ASSERT_EQ(
        run(arguments({"--sweep", "antialiasing", "--methods", "1", "--depths", "2,4",
                       "--thresholds", "0.3,0.03", "--max-error", "200", "--max-seconds", "60"})),
        0)
        << output_;
    const json found = read();
    EXPECT_EQ(found["format"], "mpipov-tradeoff");
    EXPECT_EQ(found["version"], 1);
    EXPECT_TRUE(found["complete"].get<bool>());
    EXPECT_EQ(found["image"]["depth"], "uint16");
    std::vector<std::string> names;
    for (const json& one : found["rows"]) names.push_back(one["name"]);
    EXPECT_THAT(names, ElementsAre("aa-off", "aa-m1-d2-t0.3", "aa-m1-d4-t0.3", "aa-m1-d2-t0.03",
                                   "aa-m1-d4-t0.03"));
    const auto error = [&](const char* name) {
        return row(found, name)["against_truth"]["rms"].get<double>();
    };
    EXPECT_GT(error("aa-off"), 2 * error("aa-m1-d2-t0.3"));
    EXPECT_GT(error("aa-m1-d2-t0.3"), error("aa-m1-d4-t0.03"));
    EXPECT_LT(row(found, "aa-off")["against_truth"]["ssim"], 1);
    EXPECT_TRUE(row(found, "aa-off")["against_serial"].is_null());
    EXPECT_EQ(found["truth"]["samples_per_pixel"], 164);
    EXPECT_GT(found["truth"]["error"], 0);
    EXPECT_LT(found["truth"]["error"], error("aa-off") / 5);
    EXPECT_THAT(found["front"]["cpu"]["settings"].get<std::vector<std::string>>(),
                Contains("aa-m1-d4-t0.03"));
    for (const char* file :
         {"out/images/aa-off.png", "out/images/truth.png", "out/tradeoff.png", "out/crops.png"})
        EXPECT_TRUE(fs::exists(path(file))) << file;

    // All fit: the fastest, and the most accurate.
    ASSERT_THAT(found["picks"], SizeIs(2));
    EXPECT_EQ(found["picks"][1]["setting"], "aa-m1-d4-t0.03");
    const std::string command =
        fmt::format("povray {} +W40 +H30 +A0.03 +AM1 +R4 +WT1", scene("effects/reflection.pov"));
    EXPECT_EQ(found["picks"][1]["command"], command);
    EXPECT_THAT(output_, HasSubstr("--max-seconds 60: method 1, depth 4, threshold 0.03"));
    EXPECT_THAT(output_, HasSubstr(command));
    EXPECT_THAT(output_, HasSubstr("Halving the error costs"));
}

TEST_F(TradeoffProgram, SectionsAreComparedWithTheirSerialRender) {
    ASSERT_EQ(run(arguments({"--sweep", "decomposition", "--sections", "2,4000", "--halos", "2",
                             "--ranks", "1"})),
              0)
        << output_;
    const json found = read();
    for (const char* name : {"aligned-g2", "halo2-g2"}) {
        const json one = row(found, name);
        EXPECT_TRUE(one["against_serial"]["identical"].get<bool>()) << name;
        EXPECT_THAT(one["command"].get<std::string>(), HasSubstr("mpipov")) << name;
        EXPECT_THAT(one["command"].get<std::string>(), HasSubstr("+A0.3 +AM1 +R3")) << name;
        EXPECT_GT(one["cpu"][0], 0) << name;
    }
    EXPECT_EQ(row(found, "aligned-g2")["serial"], "serial");
    EXPECT_EQ(row(found, "halo2-g2")["serial"], "serial-oneblock");
    EXPECT_EQ(row(found, "aligned-g2")["sections"], 2);
    EXPECT_TRUE(row(found, "aligned-g4000").is_null());
    ASSERT_THAT(found["left_out"], SizeIs(1));
    EXPECT_EQ(found["left_out"][0]["what"], "aligned-g4000");
}

TEST_F(TradeoffProgram, NoSettingFits) {
    EXPECT_EQ(run(counted({"--max-error", "0", "--max-seconds", "60"})), 1);
    EXPECT_THAT(output_, HasSubstr("--max-error 0: no setting does that"));
    const json found = read();
    EXPECT_TRUE(found["picks"][0]["setting"].is_null());
    EXPECT_FALSE(found["picks"][1]["setting"].is_null());
}

TEST_F(TradeoffProgram, GoesOnFromWhatWasMeasured) {
    ASSERT_EQ(run(counted({})), 0) << output_;
    EXPECT_EQ(renders(), 4);  // two settings, and the truth's two
    ASSERT_EQ(run(counted({})), 0);
    EXPECT_EQ(renders(), 0);
    EXPECT_THAT(output_, HasSubstr("going on from an earlier measurement: 2 of 2 settings"));
    ASSERT_EQ(run(counted({}, "2")), 0);
    EXPECT_EQ(renders(), 2);
    EXPECT_THAT(row(read(), "aa-off")["wall"], SizeIs(2));

    ASSERT_EQ(run(counted({"+W48"})), 0);
    EXPECT_EQ(renders(), 4);
    EXPECT_THAT(output_, HasSubstr("measuring all again: "));
    EXPECT_EQ(read()["image"]["width"], 48);

    // A picture that is gone is rendered again, and it alone.
    fs::remove(path("out/images/aa-off.png"));
    ASSERT_EQ(run(counted({"+W48"})), 0);
    EXPECT_EQ(renders(), 1);
}

TEST_F(TradeoffProgram, AnInterruptedRunGoesOn) {
    // The second render never ends.
    std::ofstream(path("slow-povray"))
        << "#!/bin/sh\ncase \"$*\" in *serial-aa-m1*) touch started; sleep 60;; esac\n"
           "exec povray \"$@\"\n";
    fs::permissions(path("slow-povray"), fs::perms::owner_all);
    fs::copy_file(path("counting-povray"), path("good-povray"));
    fs::rename(path("slow-povray"), path("counting-povray"));
    ChildRequest request;
    request.argv = {MPIPOV_VALIDATE_PROGRAM, "tradeoff"};
    const std::vector<std::string> words = counted({});
    request.argv.insert(request.argv.end(), words.begin(), words.end());
    request.working_directory = folder_.path();
    request.grace_seconds = 30;
    ChildProcess child = ChildProcess::start(request);
    while (!child.poll()) {
        if (fs::exists(path("started"))) child.terminate();
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_EQ(child.result().exit_code, 5) << child.output();
    EXPECT_FALSE(read()["complete"].get<bool>());
    EXPECT_THAT(row(read(), "aa-off")["wall"], SizeIs(1));
    EXPECT_THAT(std::string(child.output()), HasSubstr("NOT COMPLETE"));

    fs::rename(path("good-povray"), path("counting-povray"));
    ASSERT_EQ(run(counted({})), 0) << output_;
    EXPECT_EQ(renders(), 3);  // what was interrupted, and the truth
    EXPECT_TRUE(read()["complete"].get<bool>());
}

TEST_F(TradeoffProgram, ARegionIsMeasuredAlone) {
    ASSERT_EQ(run(counted({"+SC11", "+EC30", "+SR6", "+ER25"})), 0) << output_;
    const json part = read();
    EXPECT_EQ(part["region"]["x0"], 10);
    const json against = row(part, "aa-off")["against_truth"];
    EXPECT_TRUE(against["ssim"].is_null());
    EXPECT_GT(against["rms"], 2 * part["truth"]["error"].get<double>());
    EXPECT_GT(against["rms"], row(part, "aa-m1-d2-t0.3")["against_truth"]["rms"]);
}

TEST_F(TradeoffProgram, OtherErrors) {
    EXPECT_EQ(run({}), 2);
    EXPECT_THAT(output_, HasSubstr("no scene"));
    EXPECT_EQ(run({"scene.pov", "--nonsense"}), 2);
    EXPECT_EQ(run({"scene.pov", "--sweep", "everything"}), 2);
    EXPECT_THAT(output_, HasSubstr("'everything' is not one of antialiasing"));
    EXPECT_EQ(run({"scene.pov", "--thresholds", "0.3,x"}), 2);
    EXPECT_EQ(run({"scene.pov", "--depths", "10"}), 2);
    EXPECT_EQ(run({"scene.pov", "--average", "somehow"}), 2);
    EXPECT_EQ(run(arguments({"--sweep", "radiosity"})), 2);
    EXPECT_THAT(output_, HasSubstr("the scene has no radiosity"));
    EXPECT_EQ(run({"missing.pov", "--out", "out"}), 3);
    EXPECT_EQ(run(arguments({"--povray", "./missing"})), 3);
    EXPECT_EQ(run({"--help"}), 0);
    for (const char* option :
         {"--sweep", "--depths", "--max-error", "--max-seconds", "--truth-samples", "Exit code"})
        EXPECT_THAT(output_, HasSubstr(option));
}

}  // namespace
}  // namespace mpipov
