#include "scene_effects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mpipov {
namespace {

using testing::HasSubstr;

// Of 640 x 480 pixels, 40 x 30 were rendered in 0.1 s.
ProbeResult small_render() {
    ProbeResult probe;
    probe.image.width = 640;
    probe.image.height = 480;
    probe.image.region = {0, 0, 640, 480};
    probe.probe_pixels = 40 * 30;
    probe.report.trace_cpu = 0.1;
    return probe;
}

TEST(SceneEffects, AreWhatPovraySaid) {
    ProbeResult probe = small_render();
    probe.report.antialiasing = {true, 2, 3, 0.3};
    probe.report.photons = true;
    probe.report.photon_cpu = 1.5;
    probe.report.counters = {{"Media Samples", 9}, {"Transmitted Rays", 3}, {"Reflected Rays", 0}};
    const auto effects = find_effects(probe);
    EXPECT_TRUE(effects.at("antialiasing").on);
    EXPECT_THAT(effects.at("antialiasing").why, HasSubstr("Method 2"));
    EXPECT_TRUE(effects.at("photons").on);
    EXPECT_EQ(effects.at("photons").cpu_seconds, 1.5);
    EXPECT_TRUE(effects.at("media").on);
    EXPECT_TRUE(effects.at("transparency").on);
    for (const char* off : {"reflection", "isosurface", "radiosity", "order_dependent"})
        EXPECT_FALSE(effects.at(off).on) << off;
    for (const auto& [name, effect] : effects) EXPECT_FALSE(effect.why.empty()) << name;
}

LaunchReport counting(long long rays, long long shadow_tests) {
    LaunchReport report;
    report.trace_cpu = 0.1;
    report.counters = {{"Pixels", 1200}, {"Rays", rays}, {"Shadow Ray Tests", shadow_tests}};
    return report;
}

// At every level the same.
ProbeResult looked_at() {
    ProbeResult probe = small_render();
    probe.look = QualityLook{1200, {}, {}};
    for (const int level : {4, 5, 6, 8, 9}) probe.look->plain[level] = counting(1200, 500);
    return probe;
}

TEST(SceneEffects, WithoutACloserLookItSaysNothingOfSome) {
    const auto effects = find_effects(small_render());
    for (const char* name : {"area_light", "focal_blur", "subsurface"})
        EXPECT_EQ(effects.count(name), 0u) << name;
}

TEST(SceneEffects, WhatIsOffCostsNothing) {
    for (const auto& [name, effect] : find_effects(looked_at())) {
        if (name == "render") continue;
        EXPECT_FALSE(effect.on) << name;
        EXPECT_EQ(effect.cpu_seconds, 0.0) << name;
    }
}

TEST(SceneEffects, AreaLightsAreWhatLevelFiveAdds) {
    ProbeResult probe = looked_at();
    probe.look->plain.at(4).counters["Shadow Ray Tests"] = 499;
    const Effect effect = find_effects(probe).at("area_light");
    EXPECT_TRUE(effect.on);
    EXPECT_THAT(effect.why, testing::AllOf(HasSubstr("500"), HasSubstr("499")));
    for (const int level : {5, 6, 8, 9}) probe.look->plain.erase(level);
    EXPECT_FALSE(find_effects(probe).at("area_light").on) << "the user has no more than +Q4";
}

TEST(SceneEffects, FocalBlurIsMoreThanOneRayOfAPixel) {
    ProbeResult probe = looked_at();
    probe.look->plain.at(9).counters["Rays"] = 9000;  // reflected ones, photons, ...
    EXPECT_FALSE(find_effects(probe).at("focal_blur").on);
    probe.look->plain.at(4).counters["Rays"] = 1201;
    EXPECT_TRUE(find_effects(probe).at("focal_blur").on);
    probe.look->plain.at(4).counters["Rays"] = 800;  // a fisheye has none in the corners
    EXPECT_FALSE(find_effects(probe).at("focal_blur").on);
}

TEST(SceneEffects, SubsurfaceIsWhatLevelNineAddsAndNothingElseExplains) {
    ProbeResult probe = looked_at();
    probe.look->plain.at(8).counters["Shadow Ray Tests"] = 100;
    for (const int level : {4, 5, 6, 8}) probe.look->plain.at(level).trace_cpu = 0.04;
    const Effect effect = find_effects(probe).at("subsurface");
    EXPECT_TRUE(effect.on);
    EXPECT_NEAR(effect.cpu_seconds.value(), 0.06 * 256, 1e-9);
    probe.report.counters["Media Samples"] = 7;
    EXPECT_EQ(find_effects(probe).count("subsurface"), 0u) << "it may be the media";
}

TEST(SceneEffects, WhatIsOnWithoutACostSaysWhy) {
    ProbeResult probe = looked_at();
    probe.report.counters = {{"Media Samples", 1},
                             {"Isosurface roots", 1},
                             {"Reflected Rays", 1},
                             {"Transmitted Rays", 1}};
    probe.order_dependent = true;
    const auto effects = find_effects(probe);
    for (const char* name :
         {"media", "isosurface", "reflection", "transparency", "order_dependent"}) {
        EXPECT_TRUE(effects.at(name).on) << name;
        EXPECT_FALSE(effects.at(name).cpu_seconds) << name;
        EXPECT_THAT(effects.at(name).why, HasSubstr("cost")) << name;
    }
}

TEST(SceneEffects, WhatLevelNineAddsIsNotGivenToOneOfTwo) {
    ProbeResult probe = looked_at();
    for (const int level : {4, 5, 6, 8}) probe.look->plain.at(level).trace_cpu = 0.05;
    probe.report.counters["Media Samples"] = 7;
    EXPECT_NEAR(find_effects(probe).at("media").cpu_seconds.value(), 0.05 * 256, 1e-9);
    probe.report.photons = true;
    probe.report.photon_cpu = 1.5;
    const auto effects = find_effects(probe);
    EXPECT_FALSE(effects.at("media").cpu_seconds);
    EXPECT_THAT(effects.at("media").why, HasSubstr("media and photons"));
    EXPECT_EQ(effects.at("photons").cpu_seconds, 1.5) << "what every launch does again";
}

}  // namespace
}  // namespace mpipov
