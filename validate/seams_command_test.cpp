// `noise` and `seams` as programs, with the POV-Ray that is installed.

#include "program_test.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

class RenderPrograms : public ProgramTest {
  protected:
    RenderPrograms() : ProgramTest({}) {}

    json read(const char* name) const {
        std::ifstream in(folder_.path() / name);
        return json::parse(in);
    }
    std::string bytes_of(const std::string& name) const {
        std::ifstream in(path(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    void program(const char* name, const std::string& script) const {
        const fs::path file = folder_.path() / name;
        std::ofstream(file) << "#!/bin/sh\n" << script;
        fs::permissions(file, fs::perms::owner_all);
    }
    // Runs mpiexec, and then puts another scene of 64 x 48 pixels in the image's place.
    void make_damaging_mpiexec() {
        program("damaging-mpiexec",
                "mpiexec \"$@\" || exit\n"
                "for last; do :; done\n"
                "cp other.png \"${last#+O}.png\"\n");
        ChildRequest other;
        other.argv = {"povray",     scene("basic/spheres.pov"), "+W64", "+H48", "-A", "+WT1", "-D",
                      "+Oother.png"};
        other.working_directory = folder_.path();
        ASSERT_EQ(run_to_end(other, &output_).exit_code, 0) << output_;
    }
    static std::string scene(const char* name) { return fmt::format("{}/{}", MPIPOV_SCENES, name); }
};

TEST_F(RenderPrograms, AnExactSceneIsIdenticalInSections) {
    EXPECT_EQ(run({"seams", scene("effects/none.pov"), "+W64", "+H48", "-A", "--out", "out",
                   "--ranks", "1,1", "--sections", "2,40,2", "--seams", "aligned,aligned",
                   "--shape", "columns,columns", "--schedule", "dynamic,dynamic"}),
              0)
        << output_;
    const json found = read("out/seams.json");
    EXPECT_TRUE(found["complete"].get<bool>());
    EXPECT_EQ(found["scene"], "none");
    EXPECT_THAT(found["noise"]["why_not"].get<std::string>(), HasSubstr("does not depend"));
    ASSERT_EQ(found["cases"].size(), 1U);
    EXPECT_EQ(found["cases"][0]["name"], "dynamic.np1.columns.aligned.g2");
    EXPECT_EQ(found["cases"][0]["verdict"]["verdict"], "identical");
    EXPECT_EQ(found["cases"][0]["comparison"]["differing"], 0);
    EXPECT_EQ(found["skipped"].size(), 1U);
    EXPECT_TRUE(fs::exists(folder_.path() / "out" / found["cases"][0]["image"].get<std::string>()));
    EXPECT_TRUE(fs::exists(folder_.path() / "out/serial-default.png"));
}

// The image is another scene when it comes to be compared.
TEST_F(RenderPrograms, DamageInAnExactSceneIsFound) {
    ASSERT_NO_FATAL_FAILURE(make_damaging_mpiexec());
    EXPECT_EQ(
        run({"seams", scene("effects/none.pov"), "+W64", "+H48", "-A", "--out", "out", "--ranks",
             "1", "--sections", "2", "--seams", "aligned", "--mpiexec", "./damaging-mpiexec"}),
        1)
        << output_;
    const json found = read("out/seams.json");
    EXPECT_EQ(found["cases"][0]["verdict"]["verdict"], "differs");
    EXPECT_FALSE(found["cases"][0]["verdict"]["ok"].get<bool>());
    EXPECT_EQ(found["conditioning"]["verdict"]["verdict"], "well-conditioned");
}

// Plain seams with antialiasing of method 1 may differ, but not by everything.
TEST_F(RenderPrograms, DamageIsFoundWherePlainSeamsMayDiffer) {
    ASSERT_NO_FATAL_FAILURE(make_damaging_mpiexec());
    EXPECT_EQ(run({"seams", scene("basic/checker.pov"), "+W64", "+H48", "+A0.3", "+AM1", "--out",
                   "out", "--ranks", "1", "--sections", "2", "--seams", "plain",
                   "--no-conditioning", "--mpiexec", "./damaging-mpiexec"}),
              1)
        << output_;
    EXPECT_TRUE(read("out/seams.json")["conditioning"].is_null());
    EXPECT_EQ(run({"seams", scene("basic/checker.pov"), "+W64", "+H48", "+A0.3", "+AM1", "--out",
                   "out", "--ranks", "1", "--sections", "2", "--seams", "plain"}),
              0)
        << output_;
}

TEST_F(RenderPrograms, AFailedCaseIsWritten) {
    program("broken-mpiexec", "echo it went up in smoke\nexit 7\n");
    EXPECT_EQ(run({"seams", scene("effects/none.pov"), "+W64", "+H48", "--out", "out", "--ranks",
                   "1", "--sections", "2", "--seams", "aligned", "--mpiexec", "./broken-mpiexec"}),
              3)
        << output_;
    const json found = read("out/seams.json");
    EXPECT_TRUE(found["complete"].get<bool>());
    EXPECT_THAT(found["cases"][0]["failure"].get<std::string>(), HasSubstr("smoke"));
    EXPECT_EQ(found["cases"][0]["verdict"]["verdict"], "failed");
}

TEST_F(RenderPrograms, WhatStopsEverythingIsWrittenToo) {
    EXPECT_EQ(run({"seams", scene("effects/none.pov"), "--out", "out", "--povray", "./none"}), 3);
    EXPECT_THAT(read("out/seams.json")["failure"].get<std::string>(), HasSubstr("./none"));
    std::ofstream(folder_.path() / "broken.pov") << "sphere { nonsense }\n";
    EXPECT_EQ(run({"seams", "broken.pov", "+W32", "+H24", "--out", "out"}), 3) << output_;
    EXPECT_THAT(read("out/seams.json")["failure"].get<std::string>(), HasSubstr("POV-Ray: "));
    EXPECT_FALSE(read("out/seams.json")["complete"].get<bool>());
}

TEST_F(RenderPrograms, AnEarlierResultOutlivesARunThatJudgedNothing) {
    const auto seams = [&](const std::string& file, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"seams", file,      "+W64",    "+H48",
                                           "-A",    "--out",   "out",     "--ranks",
                                           "1",     "--seams", "aligned", "--sections"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    };
    ASSERT_EQ(seams(scene("effects/none.pov"), {"2"}), 0) << output_;
    const std::vector<std::string> files{"out/seams.json", "out/serial-default.png",
                                         "out/dynamic.np1.columns.aligned.g2/run.json",
                                         "out/dynamic.np1.columns.aligned.g2/image.png"};
    std::vector<std::string> earlier;
    earlier.reserve(files.size());
    for (const std::string& file : files) earlier.push_back(bytes_of(file));
    const auto unchanged = [&](const std::string& what) {
        for (std::size_t i = 0; i < files.size(); ++i)
            EXPECT_EQ(bytes_of(files[i]), earlier[i]) << files[i] << ": " << what;
        EXPECT_EQ(std::distance(fs::directory_iterator(path("out")), {}), 3) << what;
    };

    EXPECT_EQ(seams("none.pov", {"2"}), 3) << output_;
    unchanged("no such scene");
    EXPECT_EQ(seams(scene("basic/spheres.pov"), {"2", "--mpiexec", "./none"}), 4) << output_;
    unchanged("no such mpiexec, of another scene");
    program("refusing-mpiexec", "echo no such grid\nexit 2\n");
    EXPECT_EQ(seams(scene("basic/spheres.pov"), {"2", "--mpiexec", "./refusing-mpiexec"}), 2);
    unchanged("a grid that was there before, of another scene");

    program("broken-mpiexec", "exit 7\n");
    EXPECT_EQ(seams(scene("basic/spheres.pov"), {"2", "--mpiexec", "./broken-mpiexec"}), 3);
    EXPECT_EQ(read("out/seams.json")["scene"], "spheres") << "a case that fails is a result";
    EXPECT_NE(bytes_of(files[1]), earlier[1]);
    EXPECT_FALSE(fs::exists(path(files[2]))) << "of the earlier scene";
}

// Or they would be taken for those of the scene that the earlier noise.json names.
TEST_F(RenderPrograms, EarlierSerialRendersOutliveARunThatFails) {
    const auto noise = [&](const std::string& file, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"noise", file,  "+W64",      "+H48", "-A",
                                           "--out", "out", "--renders", "3"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    };
    ASSERT_EQ(noise(scene("effects/none.pov"), {}), 0) << output_;
    const std::string json_before = bytes_of("out/noise.json"),
                      image_before = bytes_of("out/serial-default.png");
    // Fails at the first render in another order.
    program("failing-povray", "case \"$*\" in *RP2*-D*) exit 1;; esac\nexec povray \"$@\"\n");
    EXPECT_EQ(noise(scene("basic/spheres.pov"), {"--povray", "./failing-povray"}), 3) << output_;
    EXPECT_EQ(bytes_of("out/noise.json"), json_before);
    EXPECT_EQ(bytes_of("out/serial-default.png"), image_before);
    EXPECT_EQ(std::distance(fs::directory_iterator(path("out")), {}), 2);
}

TEST_F(RenderPrograms, NoiseOfANoisyScene) {
    EXPECT_EQ(run({"noise", scene("effects/crand.pov"), "+W96", "+H64", "+A0.3", "+AM1",
                   "--renders", "3", "--out", "out", "--json", "-"}),
              0)
        << output_;
    const json found = read("out/noise.json");
    EXPECT_FALSE(found["exact"].get<bool>());
    ASSERT_EQ(found["noise"]["renders"].size(), 3U);
    EXPECT_GT(found["noise"]["sigma"].get<double>(), 0.5);
    EXPECT_TRUE(fs::exists(folder_.path() / "out" /
                           found["noise"]["renders"][0]["image"].get<std::string>()));
}

TEST_F(RenderPrograms, SerialRendersServeAgain) {
    fs::copy_file(scene("effects/crand.pov"), path("crand.pov"));
    std::ofstream(path("crand.pov"), std::ios::app) << "#include \"more.inc\"\n";
    std::ofstream(path("more.inc")) << "sphere { 0, 0.1 }\n";
    std::ofstream(path("size.ini")) << "Width=96\nHeight=64\n";
    const std::vector<std::string> scene_and_size{"crand.pov", "size.ini", "+A0.3", "+AM1"};
    const auto call = [&](std::vector<std::string> arguments,
                          const std::vector<std::string>& more) {
        arguments.insert(arguments.begin() + 1, scene_and_size.begin(), scene_and_size.end());
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    };
    ASSERT_EQ(call({"noise", "--out", "serial"}, {"--renders", "4"}), 0) << output_;
    EXPECT_TRUE(fs::exists(path("serial/serial-oneblock.png")));

    const std::vector<std::string> judge{"seams",  "--out",   "out",        "--serial",
                                         "serial", "--ranks", "1",          "--sections",
                                         "2",      "--seams", "halo,plain", "--renders"};
    EXPECT_EQ(call(judge, {"4"}), 0) << output_;
    EXPECT_THAT(output_, testing::Not(HasSubstr("rendering the serial reference")));
    const json found = read("out/seams.json");
    EXPECT_EQ(found["scene"], "crand");
    EXPECT_EQ(found["references"]["oneblock"]["image"], "serial-oneblock.png");
    EXPECT_EQ(found["noise"]["renders"].size(), 4U);
    for (const json& one : found["cases"]) {
        EXPECT_EQ(one["verdict"]["verdict"], "within noise");
        EXPECT_LT(one["comparison"]["ssim"]["value"], 1);
        EXPECT_GT(one["verdict"]["step_test"]["detectable"], 0);
    }

    EXPECT_EQ(call(judge, {"5"}), 2) << output_;
    EXPECT_THAT(output_, HasSubstr("only 4 renders"));
    EXPECT_EQ(call(judge, {"4", "+A0.2"}), 2) << output_;
    EXPECT_THAT(output_, HasSubstr("other arguments"));
    for (const auto& [file, more] :
         {std::pair{"more.inc", "// changed\n"}, std::pair{"size.ini", "; changed\n"},
          std::pair{"crand.pov", "// changed\n"}}) {
        const std::string before = bytes_of(file);
        std::ofstream(path(file), std::ios::app) << more;
        EXPECT_EQ(call(judge, {"4"}), 2) << output_;
        EXPECT_THAT(output_, HasSubstr(fmt::format("'{}' changed", file)));
        std::ofstream(path(file)) << before;
    }
    EXPECT_EQ(call({"seams", "--out", "out", "--serial", "none"}, {}), 4) << output_;
    const json good = read("serial/noise.json");
    const auto refused = [&](const std::string& text, const std::string& why) {
        std::ofstream(path("serial/noise.json")) << text;
        EXPECT_EQ(call(judge, {"4"}), 4) << output_;
        EXPECT_THAT(output_, HasSubstr("cannot use 'serial/noise.json': " + why));
        EXPECT_THAT(output_, testing::Not(HasSubstr("json.exception")));
    };
    refused("{}", "it lacks 'arguments'");
    refused("{", "parse error");
    json bad = good;
    bad["wanted"] = "four";
    refused(bad.dump(), "its 'wanted': must be a whole number, but is string");
    bad = good;
    bad["references"]["default"].erase("image");
    refused(bad.dump(), "it lacks 'image'");
    bad = good;
    bad["references"].erase("default");
    refused(bad.dump(), "its 'references' lack 'default'");
}

TEST_F(RenderPrograms, UsageErrors) {
    EXPECT_EQ(run({"seams", "scene.pov"}), 2);
    EXPECT_EQ(run({"seams", "--out", "out"}), 2);
    EXPECT_THAT(output_, HasSubstr("no scene"));
    EXPECT_EQ(run({"noise", "scene.pov", "--nonsense"}), 2);
    EXPECT_THAT(output_, HasSubstr("--nonsense"));
    EXPECT_EQ(run({"seams", "scene.pov", "--out", "out", "--ranks", "1,x"}), 2);
    EXPECT_EQ(run({"seams", "scene.pov", "--out", "out", "--seams", "halo:0"}), 2);
    EXPECT_EQ(run({"seams", "scene.pov", "--out", "out", "--schedule", "sometimes"}), 2);
    EXPECT_THAT(output_, HasSubstr("'sometimes' is not one of static, dynamic, cost"));
    EXPECT_EQ(run({"seams", "none.pov", "--out", "out", "--schedule", "static,dynamic,cost"}), 3)
        << "all of them are known";
    EXPECT_EQ(run({"seams", scene("effects/none.pov"), "+W64", "+H48", "-A", "--out", "out",
                   "--ranks", "1", "--sections", "5000", "--seams", "aligned"}),
              2)
        << "of no grid that can be";
    EXPECT_THAT(output_, HasSubstr("nothing was judged"));
    EXPECT_EQ(run({"noise", "scene.pov", "--renders", "1"}), 2);
    std::ofstream(path("scene.pov")) << "// empty";
    EXPECT_EQ(run({"noise", "scene.pov", "--json", "./scene.pov"}), 2);
    EXPECT_THAT(output_, HasSubstr("--json would overwrite 'scene.pov'"));
    EXPECT_EQ(run({"seams", "--help"}), 0);
}

}  // namespace
}  // namespace mpipov
