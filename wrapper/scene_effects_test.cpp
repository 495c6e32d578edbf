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

}  // namespace
}  // namespace mpipov
