// With the installed POV-Ray, on small scenes written here and on those of scenes/.
#include "probe.h"

#include "cost_model.h"
#include "failure.h"
#include "povray_command.h"
#include "radiosity_cache.h"
#include "scene_plan.h"
#include "scratch.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* ball = R"(
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -4> look_at 0 }
light_source { <5, 8, -6> 1 }
sphere { 0, 1 pigment { rgb <0.9, 0.4, 0.2> } }
)";

class ProbeTest : public testing::Test {
  protected:
    void SetUp() override {
        if (std::system("command -v povray >/dev/null 2>&1") != 0)
            GTEST_SKIP() << "there is no povray on the PATH";
    }

    fs::path file(const std::string& name) const { return scratch_.path() / name; }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(file(name)) << text;
        return file(name).string();
    }
    std::string read(const std::string& name) const {
        std::ifstream in(file(name));
        return {std::istreambuf_iterator<char>(in), {}};
    }

    // Probes `scene`, 64 x 48 with an output in our folder, and `more`.
    Probe probe(const std::string& scene, const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments{scene, "+W64", "+H48", "+O" + file("out").string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_probe({"povray", quote_arguments(arguments), file("probe"), 60.0});
    }
    void expect_refused(Exit code, const std::string& scene, const std::vector<std::string>& more,
                        const std::string& text) const {
        SCOPED_TRACE(testing::PrintToString(more));
        fs::remove_all(file("probe"));
        try {
            probe(scene, more);
            FAIL() << "accepted";
        } catch (const Failure& failure) {
            EXPECT_EQ(failure.code(), code) << failure.what();
            EXPECT_THAT(failure.what(), HasSubstr(text));
        }
    }

  private:
    ScratchFolder scratch_{"probe-test"};
};

TEST_F(ProbeTest, TellsWhatTheResultIs) {
    const Probe result = probe(write("ball.pov", ball), {"+A0.3", "+AM2", "+R2"});
    EXPECT_EQ(result.result.image.width, 64);
    EXPECT_EQ(result.result.image.height, 48);
    EXPECT_EQ(result.result.image.region, (Rect{0, 0, 64, 48}));
    EXPECT_EQ(result.result.image.output_file, file("out.png"));
    EXPECT_EQ(result.result.stored.type, "png");
    EXPECT_EQ(result.result.stored.depth, "uint8");
    EXPECT_EQ(result.result.stored.channels, 3);
    EXPECT_EQ(result.result.report.antialiasing.method, 2);
    EXPECT_EQ(result.result.report.antialiasing.depth, 2);
    EXPECT_FALSE(result.result.plain.antialiasing.on);
    EXPECT_EQ(counter(result.result.plain, "Samples"), 0);
    EXPECT_EQ(counter(result.result.plain, "Pixels"), result.result.probe_pixels);
    EXPECT_EQ(result.result.quality, 9);
    EXPECT_EQ(result.result.user_block, 0);
    EXPECT_FALSE(result.result.order_dependent);
    EXPECT_EQ(result.style.extension, ".png");
    EXPECT_TRUE(fs::exists(result.style.sample));
    EXPECT_THAT(result.warnings, IsEmpty());
    EXPECT_GT(result.cpu_seconds, 0);
    EXPECT_EQ(result.launches, 5);
    const PixelLayout sample = read_layout(result.style.sample);
    EXPECT_EQ(result.result.probe_pixels, static_cast<long long>(sample.width) * sample.height);
}

TEST_F(ProbeTest, TouchesNothingOfTheUsers) {
    const std::string scene = write("ball.pov", ball);
    write("out.png", "the last picture");
    write("out.pov-state", "a render that can go on");
    probe(scene, {"Create_Ini=" + file("mine.ini").string()});
    EXPECT_EQ(read("out.png"), "the last picture");
    EXPECT_EQ(read("out.pov-state"), "a render that can go on");
    EXPECT_FALSE(fs::exists(file("mine.ini")));
}

TEST_F(ProbeTest, RadiosityIsToldOnceAndItsSamplesAreKept) {
    const std::string lit = fmt::format(
        "{}\nplane {{ y, -1 pigment {{ rgb 1 }} }}\n"
        "global_settings {{ radiosity {{ pretrace_start 0.1 pretrace_end 0.02 }} }}",
        ball);
    for (const bool radiosity : {true, false}) {
        fs::remove_all(file("probe"));
        int told = 0;
        const Probe result = run_probe({"povray",
                                        {write("lit.pov", radiosity ? lit : ball), "+W640", "+H480",
                                         "+O" + file("out").string()},
                                        file("probe"),
                                        60.0,
                                        [&] { ++told; }});
        EXPECT_EQ(told, radiosity ? 1 : 0);
        EXPECT_EQ(result.result.order_dependent, radiosity);
        EXPECT_EQ(result.radiosity_cache.empty(), !radiosity);
        RadiosityCache whole;
        EXPECT_NO_THROW(whole.add(result.radiosity_cache));
    }
}

TEST_F(ProbeTest, AUsersRadiosityCacheIsSeenAndLeftAlone) {
    const std::string scene = write("ball.pov", ball);
    const std::string cache = "+RF" + file("mine.rca").string();
    EXPECT_TRUE(probe(scene, {"+RFO", cache}).result.writes_cache);
    EXPECT_FALSE(fs::exists(file("mine.rca")));
    fs::remove_all(file("probe"));
    EXPECT_FALSE(probe(scene).result.writes_cache);
    fs::remove_all(file("probe"));
    write("mine.rca", "");
    EXPECT_TRUE(probe(scene, {"+RFI", cache}).result.own_cache);
    EXPECT_EQ(read("mine.rca"), "");
}

TEST_F(ProbeTest, AsksAgainWhereASceneRefusesToBeSmall) {
    const Probe result = probe(write(
        "large.pov", fmt::format("{}\n#if (image_width < 60) #error \"too small\" #end", ball)));
    EXPECT_TRUE(fs::exists(result.style.sample));
    EXPECT_EQ(result.launches, 9);
    EXPECT_EQ(result.result.probe_pixels, 32 * 32);
    EXPECT_FALSE(result.result.seen_whole);
    PlanRequest request;
    request.slots = {1};
    EXPECT_TRUE(make_plan(request, result.result).record.effects.at("order_dependent").on)
        << "nobody has seen the rest";
}

TEST_F(ProbeTest, SaysWhatTheWholePictureFailsOn) {
    expect_refused(
        Exit::scene,
        write("never.pov", fmt::format("{}\n#error concat(\"no \", str(image_width, 0, 0))", ball)),
        {}, "no 64");
}

struct TypeCase {
    const char* name;
    std::vector<std::string> options;
    const char *type, *depth;
    int channels;
    const char* extension;
    int quality;
    bool rle;
};

void PrintTo(const TypeCase& c, std::ostream* out) {
    *out << c.name;
}

class ProbeTypes : public ProbeTest, public testing::WithParamInterface<TypeCase> {};

TEST_P(ProbeTypes, AreTold) {
    const TypeCase& wanted = GetParam();
    const Probe result = probe(write("ball.pov", ball), wanted.options);
    EXPECT_EQ(result.style.type, wanted.type);
    EXPECT_EQ(result.result.stored.type, wanted.type);
    EXPECT_EQ(result.result.stored.depth, wanted.depth);
    EXPECT_EQ(result.result.stored.channels, wanted.channels);
    EXPECT_EQ(result.style.extension, wanted.extension);
    EXPECT_EQ(result.style.jpeg_quality, wanted.quality);
    EXPECT_EQ(result.style.rle, wanted.rle);
    EXPECT_FALSE(result.result.order_dependent);
}

INSTANTIATE_TEST_SUITE_P(
    Types, ProbeTypes,
    testing::Values(TypeCase{"png16", {"+FN16"}, "png", "uint16", 3, ".png", 0, false},
                    TypeCase{"png_alpha", {"+UA"}, "png", "uint8", 4, ".png", 0, false},
                    TypeCase{"grayscale", {"+FNG"}, "png", "uint16", 1, ".png", 0, false},
                    TypeCase{
                        "jpeg", {"+FJ", "Compression=60"}, "jpeg", "uint8", 3, ".jpg", 60, false},
                    TypeCase{"targa_rle", {"+FT", "+FC"}, "targa", "uint8", 3, ".tga", 0, true},
                    TypeCase{"exr", {"+FE", "+UA"}, "openexr", "half", 4, ".exr", 0, false},
                    TypeCase{"hdr", {"+FH"}, "hdr", "float", 3, ".hdr", 0, false},
                    TypeCase{"ppm", {"+FP8"}, "pnm", "uint8", 3, ".ppm", 0, false},
                    TypeCase{"bmp", {"+FB"}, "bmp", "uint8", 3, ".bmp", 0, false}),
    [](const auto& test_case) { return test_case.param.name; });

TEST_F(ProbeTest, RegionAndBlocksAreTheUsers) {
    const Probe result =
        probe(write("ball.pov", ball), {"+SC0.25", "+EC40", "+SR7", "+ER0.5", "+BS64", "+Q5"});
    EXPECT_EQ(result.result.quality, 5);
    EXPECT_EQ(result.result.image.region, (Rect{16, 6, 40, 24}));
    EXPECT_EQ(result.result.user_block, 64);
}

TEST_F(ProbeTest, AnIniFileIsAskedTooAndNamesMayHaveBlanks) {
    const std::string scene = write("my ball.pov", ball);
    const std::string ini = write("my settings.ini", "Width=40\nHeight=20\nAntialias=On\n");
    const Probe result = run_probe(
        {"povray", quote_arguments({ini, "+I" + scene, "+O" + file("my picture.png").string()}),
         file("probe"), 60.0});
    EXPECT_EQ(result.result.image.width, 40);
    EXPECT_EQ(result.result.image.height, 20);
    EXPECT_EQ(result.result.image.input_file, scene);
    EXPECT_EQ(result.result.image.output_file, file("my picture.png"));
    EXPECT_TRUE(result.result.report.antialiasing.on);
}

TEST_F(ProbeTest, OneFrameOfAnAnimationIsOneImage) {
    const std::string scene = write("ball.pov", ball);
    const Probe result = probe(scene, {"+KFF3", "+SF2", "+EF2"});
    EXPECT_EQ(result.result.image.output_file, file("out2.png"));
    expect_refused(Exit::usage, scene, {"+KFF3"}, "3 frames");
}

TEST_F(ProbeTest, WarningsArePassedOn) {
    const std::string scene =
        write("ball.pov", std::string(ball) + "#warning \"the author warns\"\n");
    EXPECT_THAT(probe(scene).warnings, ElementsAre(HasSubstr("Parse Warning: the author warns")));
}

TEST_F(ProbeTest, ErrorDiffusionDependsOnTheOrder) {
    const std::string scene = write("ball.pov", ball);
    EXPECT_TRUE(probe(scene, {"+THFS"}).result.order_dependent);
    fs::remove_all(file("probe"));
    EXPECT_FALSE(probe(scene, {"+THB4"}).result.order_dependent);
}

TEST_F(ProbeTest, WhatTheSceneLacksIsSaid) {
    expect_refused(Exit::scene, file("none.pov").string(), {}, "none.pov");
    expect_refused(Exit::scene, write("open.pov", "sphere { 0, 1"), {},
                   "No matching } in 'sphere'");
    expect_refused(Exit::scene, write("include.pov", "#include \"nowhere.inc\"\n"), {},
                   "nowhere.inc");
    expect_refused(Exit::scene, write("says.pov", "#error \"the author says no\"\n"), {},
                   "the author says no");
}

TEST_F(ProbeTest, WhatCannotBeOneImageFileIsRefused) {
    const std::string scene = write("ball.pov", ball);
    expect_refused(Exit::usage, scene, {"+ZZ5"}, "+ZZ5");
    expect_refused(Exit::usage, scene, {"+O-"}, "standard output");
    expect_refused(Exit::usage, scene, {"-F"}, "-F");
    expect_refused(Exit::usage, scene, {"+SC20", "+EC10"}, "columns 20 to 10");
    expect_refused(Exit::usage, scene, {"+W0"}, "0 x 48 pixels");
}

TEST_F(ProbeTest, ASceneThatNeverEndsIsGivenUp) {
    const std::string scene = write("endless.pov", std::string(ball) + "#while (1) #end\n");
    try {
        run_probe(
            {"povray", {scene, "+W64", "+H48", "+O" + file("out").string()}, file("probe"), 2.0});
        FAIL() << "it ended";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), Exit::scene);
        EXPECT_THAT(failure.what(), HasSubstr("--timeout"));
    }
}

TEST_F(ProbeTest, VersionIsAsked) {
    EXPECT_THAT(povray_version("povray"), testing::StartsWith("3.7"));
    for (const auto& [program, text] :
         {std::pair{"/no/such/povray", "cannot start"}, std::pair{"true", "is not POV-Ray 3.7"},
          std::pair{"sh", "is not POV-Ray 3.7"}}) {
        try {
            povray_version(program);
            ADD_FAILURE() << "accepted " << program;
        } catch (const Failure& failure) {
            EXPECT_EQ(failure.code(), Exit::scene);
            EXPECT_THAT(failure.what(), AllOf(HasSubstr(program), HasSubstr(text)));
        }
    }
}

struct Scene {
    std::string name, file;
    int width = 0, height = 0;
    std::vector<std::string> options;
    bool order_dependent = false;
    nlohmann::json effects;
};

void PrintTo(const Scene& scene, std::ostream* out) {
    *out << scene.name;
}

std::vector<Scene> all_scenes() {
    std::vector<Scene> scenes;
    std::ifstream in(fs::path(MPIPOV_SCENES) / "scenes.json");
    const nlohmann::json json = nlohmann::json::parse(in, nullptr, false);
    if (!json.is_object()) return scenes;
    for (const auto& entry : json.at("scenes"))
        scenes.push_back({entry.at("name"), entry.at("file"), entry.at("size").at(0),
                          entry.at("size").at(1), entry.at("options"), entry.at("order_dependent"),
                          entry.at("effects")});
    return scenes;
}

class ProbeScenes : public ProbeTest, public testing::WithParamInterface<Scene> {};

// What each of our scenes calls for is known beforehand: scenes.json.
TEST_P(ProbeScenes, AreSeenForWhatTheyAre) {
    const Scene& scene = GetParam();
    std::vector<std::string> arguments{
        (fs::path(MPIPOV_SCENES) / scene.file).string(), fmt::format("+W{}", scene.width),
        fmt::format("+H{}", scene.height), "+O" + file("out").string()};
    arguments.insert(arguments.end(), scene.options.begin(), scene.options.end());
    const Probe result = run_probe({"povray", quote_arguments(arguments), file("probe"), 120.0});
    PlanRequest request;
    request.slots = {1};
    const auto effects = make_plan(request, result.result).record.effects;
    EXPECT_EQ(effects.at("order_dependent").on, scene.order_dependent);
    for (const char* name : {"antialiasing", "radiosity", "photons", "media", "isosurface"}) {
        SCOPED_TRACE(name);
        EXPECT_EQ(effects.at(name).on, scene.effects.value(name, false));
    }
    for (const char* name : {"reflection", "transparency"}) {
        SCOPED_TRACE(name);
        EXPECT_TRUE(effects.at(name).on || !scene.effects.value(name, false));
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ProbeScenes, testing::ValuesIn(all_scenes()),
                         [](const auto& test_case) {
                             std::string name = test_case.param.name;
                             std::replace_if(
                                 name.begin(), name.end(),
                                 [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
                             return name;
                         });

}  // namespace
}  // namespace mpipov
