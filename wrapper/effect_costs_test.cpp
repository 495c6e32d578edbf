#include "effect_costs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>

namespace mpipov {
namespace {

using testing::HasSubstr;

LaunchReport traced(double trace_cpu) {
    LaunchReport report;
    report.trace_cpu = trace_cpu;
    report.counters = {{"Pixels", 100}, {"Rays", 100}};
    return report;
}

// Of 100 x 100 pixels, 10 x 10 were rendered: a second of theirs is 100 of the render.
ProbeResult probe_of(double trace_cpu, double plain_cpu) {
    ProbeResult probe;
    probe.image.width = probe.image.height = 100;
    probe.image.region = {0, 0, 100, 100};
    probe.probe_pixels = 100;
    probe.report = traced(trace_cpu);
    probe.plain = traced(plain_cpu);
    return probe;
}

// At the levels 4, 5, 6, 8 and 9.
ProbeResult looked_at(ProbeResult probe, std::initializer_list<double> trace_cpu) {
    QualityLook look{100, {}, {}};
    const int levels[] = {4, 5, 6, 8, 9};
    const int* level = levels;
    for (const double seconds : trace_cpu) look.plain[*level++] = traced(seconds);
    probe.look = look;
    return probe;
}

double sum_of(const EffectCosts& costs) {
    double sum = 0;
    for (const EffectCost* cost : {&costs.antialiasing, &costs.area_light, &costs.transparency,
                                   &costs.reflection, &costs.richest, &costs.focal_blur}) {
        EXPECT_GE(cost->cpu_seconds.value_or(0), 0);
        EXPECT_NE(cost->cpu_seconds.has_value(), !cost->why_none.empty());
        sum += cost->cpu_seconds.value_or(0);
    }
    return sum;
}

TEST(EffectCosts, AreTheDifferencesOfTheLevels) {
    ProbeResult probe = looked_at(probe_of(2, 1), {0.1, 0.3, 0.6, 0.8, 1});
    probe.report.antialiasing.on = true;
    const EffectCosts costs = effect_costs(probe);
    EXPECT_DOUBLE_EQ(costs.render, 200);
    EXPECT_DOUBLE_EQ(costs.area_light.cpu_seconds.value(), 20);
    EXPECT_DOUBLE_EQ(costs.transparency.cpu_seconds.value(), 30);
    EXPECT_DOUBLE_EQ(costs.reflection.cpu_seconds.value(), 20);
    EXPECT_DOUBLE_EQ(costs.richest.cpu_seconds.value(), 20);
    EXPECT_DOUBLE_EQ(costs.antialiasing.cpu_seconds.value(), 100);
    EXPECT_DOUBLE_EQ(costs.focal_blur.cpu_seconds.value(), 0);
    EXPECT_LE(sum_of(costs), costs.render);
}

TEST(EffectCosts, FocalBlurIsAllButOneRayOfAPixel) {
    ProbeResult probe = looked_at(probe_of(1, 1), {0.5, 0.5, 0.5, 0.5, 1});
    probe.look->plain.at(4).counters["Rays"] = 400;
    const EffectCosts costs = effect_costs(probe);
    EXPECT_DOUBLE_EQ(camera_rays(*probe.look), 4);
    EXPECT_DOUBLE_EQ(costs.focal_blur.cpu_seconds.value(), 75);
    EXPECT_DOUBLE_EQ(costs.richest.cpu_seconds.value(), 12.5) << "of the one ray that is left";
    EXPECT_LE(sum_of(costs), costs.render);
}

TEST(EffectCosts, NeverSumToMoreThanTheRender) {
    constexpr double huge = std::numeric_limits<double>::max();
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const std::initializer_list<double> series[] = {
        {0, 0, 0, 0, 0},           {1, 0.8, 0.9, 0.7, 0.5},    {0.1, 5, 5, 5, 1},
        {-1, -2, 3, -4, 1},        {huge, huge, 1, huge, 0.1}, {none, 1, none, 2, 3},
        {0.1, 0.2, 0.3, 0.4, huge}};
    for (const auto& seconds : series)
        for (const double trace : {0.0, 0.1, 1.0, -3.0, huge}) {
            ProbeResult probe = looked_at(probe_of(trace, trace), seconds);
            probe.report.antialiasing.on = true;
            const EffectCosts costs = effect_costs(probe);
            EXPECT_LE(sum_of(costs), costs.render * (1 + 1e-12));
        }
}

TEST(EffectCosts, BelowTheClockThereIsNone) {
    const ProbeResult probe = looked_at(probe_of(1, 1), {0.9, 0.94, 0.98, 1, 1});
    const EffectCosts costs = effect_costs(probe);
    EXPECT_FALSE(costs.area_light.cpu_seconds);
    EXPECT_THAT(costs.area_light.why_none, HasSubstr("less than 4.8 s"));
    const EffectCosts too_short = effect_costs(looked_at(probe_of(0, 0), {0, 0, 0, 0, 0}));
    EXPECT_THAT(too_short.area_light.why_none, HasSubstr("clock"));
    EXPECT_THAT(too_short.focal_blur.why_none, HasSubstr("clock"));
    EXPECT_EQ(untold_seconds(0), 0.001);
}

TEST(EffectCosts, WhatWasNotAskedForIsSaidToBe) {
    ProbeResult probe = probe_of(2, 1.5);
    probe.report.antialiasing.on = true;
    const EffectCosts costs = effect_costs(probe);
    EXPECT_DOUBLE_EQ(costs.antialiasing.cpu_seconds.value(), 50) << "the probe knows it";
    EXPECT_FALSE(costs.area_light.cpu_seconds);
    EXPECT_THAT(costs.area_light.why_none, HasSubstr("--dry-run"));
}

TEST(EffectCosts, ALargerPictureCountsByItsOwnPixels) {
    ProbeResult probe = looked_at(probe_of(0, 0), {1, 2, 2, 2, 4});
    probe.look->pixels = 400;
    probe.look->report = traced(4);
    const EffectCosts costs = effect_costs(probe);
    EXPECT_DOUBLE_EQ(costs.render, 100);
    EXPECT_DOUBLE_EQ(costs.area_light.cpu_seconds.value(), 25);
}

TEST(EffectCosts, ASmallerPictureSharesOutWhatTheProbeFound) {
    ProbeResult probe = looked_at(probe_of(2, 1), {0.1, 0.2, 0.2, 0.2, 0.25});
    probe.report.antialiasing.on = true;
    probe.look->pixels = 25;
    const EffectCosts costs = effect_costs(probe);
    EXPECT_DOUBLE_EQ(costs.render, 200);
    EXPECT_DOUBLE_EQ(costs.antialiasing.cpu_seconds.value(), 100);
    EXPECT_DOUBLE_EQ(costs.area_light.cpu_seconds.value(), 40) << "0.1 of 0.25 without it";
    EXPECT_LE(sum_of(costs), costs.render);
}

TEST(EffectCosts, ALevelAboveTheUsersIsTheUsers) {
    QualityLook look;
    look.plain[4] = traced(1);
    look.plain[5] = traced(2);
    EXPECT_EQ(at_level(look, 9).trace_cpu, 2);
    EXPECT_EQ(at_level(look, 4).trace_cpu, 1);
    look.plain.erase(4);
    EXPECT_EQ(at_level(look, 4).trace_cpu, 2) << "there is no lower one";
    look.plain[5].counters["Pixels"] = 0;
    EXPECT_EQ(camera_rays(look), 1);
}

}  // namespace
}  // namespace mpipov
