#include "quality_look.h"

#include "povray_command.h"
#include "scene_effects.h"
#include "scratch.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

ProbeResult probe_of(double trace_cpu) {
    ProbeResult probe;
    probe.image.width = 640;
    probe.image.height = 480;
    probe.image.region = {0, 0, 640, 480};
    probe.probe_pixels = 40 * 30;
    probe.plain.trace_cpu = probe.report.trace_cpu = trace_cpu;
    return probe;
}

TEST(QualityLook, AsksForWhatIsBelowTheUsers) {
    EXPECT_THAT(levels_below(9), ElementsAre(4, 5, 6, 8));
    EXPECT_THAT(levels_below(6), ElementsAre(4, 5));
    EXPECT_THAT(levels_below(4), IsEmpty());
    EXPECT_THAT(levels_below(0), IsEmpty());
}

TEST(QualityLook, IsLargeEnoughToBeTold) {
    const ImageSize small{40, 30};
    EXPECT_DOUBLE_EQ(readable_scale(probe_of(1), small), 1) << "it is already";
    EXPECT_DOUBLE_EQ(readable_scale(probe_of(0.025), small), 2);
    EXPECT_DOUBLE_EQ(readable_scale(probe_of(0), small), 8);
    ProbeResult tiny = probe_of(0);
    tiny.image.width = 80;
    EXPECT_DOUBLE_EQ(readable_scale(tiny, small), 2) << "never larger than the picture";
    tiny.image.width = 20;
    EXPECT_DOUBLE_EQ(readable_scale(tiny, small), 1);
    ProbeResult gathers = probe_of(0.001);
    gathers.plain.radiosity_cpu = 0.25;
    EXPECT_DOUBLE_EQ(readable_scale(gathers, small), 2);
}

TEST(QualityLook, CostsALongRunOnePercentAtMost) {
    const auto scale = [](const ProbeResult& probe, double wall, int cores) {
        return unnoticed_scale(probe, wall, cores).value_or(0);
    };
    EXPECT_EQ(scale(probe_of(0.001), 1, 2), 0);
    EXPECT_EQ(scale(probe_of(0.001), 30, 2), 0) << "its launches idle 0.32 s";
    EXPECT_EQ(scale(probe_of(0.001), 45, 2), 1);
    EXPECT_EQ(scale(probe_of(0.001), 45, 0), 0) << "one core at least";
    EXPECT_EQ(scale(probe_of(0.2), 45, 2), 0);
    EXPECT_EQ(scale(probe_of(1), 256, 1), 0.5) << "without antialiasing all of the render";
    EXPECT_EQ(scale(probe_of(10), 2560, 1), 0.5);
    EXPECT_EQ(scale(probe_of(10), 5120, 1), 1);
    ProbeResult parses = probe_of(0.001);
    parses.report.parse_cpu = 5;
    EXPECT_EQ(scale(parses, 600, 2), 0);
    parses.quality = 3;
    EXPECT_EQ(scale(parses, 1, 2), 1) << "nothing is launched";
    ProbeResult gathers = probe_of(1);
    gathers.plain.radiosity_cpu = 5;
    EXPECT_EQ(scale(gathers, 256, 1), 0);
    ProbeResult middle = probe_of(1);
    middle.seen_whole = false;
    EXPECT_EQ(scale(middle, 256, 1), 0) << "it has no other size";
}

// With the installed POV-Ray.
class QualityLookProbe : public testing::Test {
  protected:
    void SetUp() override {
        if (std::system("command -v povray >/dev/null 2>&1") != 0)
            GTEST_SKIP() << "there is no povray on the PATH";
    }

    void ask(const std::string& more, const std::vector<std::string>& options, double scale = 1) {
        const std::string scene = (scratch_.path() / "scene.pov").string();
        std::ofstream(scene) << "#version 3.7; global_settings { assumed_gamma 1 }\n" << more;
        std::vector<std::string> arguments{scene, "+W64", "+H48",
                                           "+O" + (scratch_.path() / "out").string()};
        arguments.insert(arguments.end(), options.begin(), options.end());
        ProbeRequest request{"povray", quote_arguments(arguments), scratch_.path() / "probe", 60.0};
        result_ = run_probe(request).result;
        request.scratch = scratch_.path() / "look";
        looked_ = look_at_qualities(request, result_, scale);
        result_.look = looked_.look;
    }
    bool finds(const char* effect) const { return find_effects(result_).at(effect).on; }

    const ScratchFolder scratch_{"quality-test"};
    ProbeResult result_;
    LookedAt looked_;
};

constexpr const char* blurred = R"(
camera { location <0, 0, -4> look_at 0 aperture 0.3 focal_point <0, 0, 1> blur_samples 7 }
light_source { <5, 8, -6> 1 }
sphere { 0, 1 pigment { rgb <0.9, 0.4, 0.2> } }
)";
constexpr const char* soft = R"(
camera { location <0, 0, -4> look_at 0 }
light_source { <5, 8, -6> 1 area_light x, y, 3, 3 }
plane { z, 2 pigment { rgb 1 } } sphere { 0, 1 pigment { rgb <0.9, 0.4, 0.2> } }
)";

TEST_F(QualityLookProbe, FindsFocalBlur) {
    ask(blurred, {});
    ASSERT_TRUE(looked_.look);
    EXPECT_EQ(looked_.launches, 4) << "the probe has the fifth";
    EXPECT_EQ(looked_.look->plain.size(), 5u);
    EXPECT_TRUE(finds("focal_blur"));
    EXPECT_FALSE(finds("area_light"));
}

TEST_F(QualityLookProbe, FindsAreaLights) {
    ask(soft, {}, 2);
    EXPECT_EQ(looked_.launches, 6) << "the larger picture at the user's quality too";
    ASSERT_TRUE(looked_.look);
    EXPECT_EQ(looked_.look->pixels, 64 * 48);
    EXPECT_TRUE(finds("area_light"));
    EXPECT_FALSE(finds("focal_blur"));
}

TEST_F(QualityLookProbe, FindsThemInASmallerPicture) {
    ask(soft, {"+A0.3"}, 0.5);
    EXPECT_EQ(looked_.launches, 5);
    ASSERT_TRUE(looked_.look);
    EXPECT_EQ(looked_.look->pixels, 16 * 12);
    EXPECT_FALSE(looked_.look->report);
    EXPECT_TRUE(finds("area_light"));
}

TEST_F(QualityLookProbe, DoesNotFindWhatTheUserLeavesOut) {
    ask(soft, {"+Q4"});
    EXPECT_EQ(result_.quality, 4);
    EXPECT_EQ(looked_.launches, 0);
    EXPECT_FALSE(finds("area_light"));
}

TEST_F(QualityLookProbe, AQualityOfElevenIsNine) {
    ask(soft, {"+Q11"});
    EXPECT_EQ(result_.quality, 9);
    EXPECT_TRUE(finds("area_light"));
}

TEST_F(QualityLookProbe, SaysNothingWhereALaunchFails) {
    ask(std::string(soft) + "#if (image_width > 40) #error \"too large\" #end", {}, 2);
    EXPECT_EQ(looked_.launches, 6);
    EXPECT_FALSE(looked_.look);
    EXPECT_EQ(find_effects(result_).count("area_light"), 0u);
}

}  // namespace
}  // namespace mpipov
