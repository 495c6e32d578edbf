// What the effects of a scene take of its render, by renders that have them and renders that do
// not. Pure. Each of these is by difference to the one before: plain picture, area lights,
// transparency, reflection, the effects of +Q9, focal blur, antialiasing; so they never sum to more
// than the render.
#pragma once

#include "probe_result.h"

#include <optional>
#include <string>

namespace mpipov {

struct EffectCost {
    std::optional<double> cpu_seconds;  // in the whole render
    std::string why_none;
};

struct EffectCosts {
    double render = 0;  // tracing the whole region, CPU seconds
    EffectCost antialiasing;
    EffectCost area_light, transparency, reflection;  // + normals
    EffectCost richest;                               // media, radiosity, photons, subsurface
    EffectCost focal_blur;
};

// Seconds by which two renders of POV-Ray's differ that are the same: its clock shows milliseconds,
// and six renders on a machine at work were within 4 % of each other.
double untold_seconds(double trace_cpu);

// The counters of the scene at this level, or the one below that is the same.
const LaunchReport& at_level(const QualityLook& look, int level);

// Rays from the camera for each pixel: at the lowest level there are no others.
double camera_rays(const QualityLook& look);

EffectCosts effect_costs(const ProbeResult& probe);

}  // namespace mpipov
