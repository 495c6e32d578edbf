#include "scene_effects.h"

#include "cost_model.h"
#include "effect_costs.h"

#include <fmt/format.h>

#include <vector>

namespace mpipov {
namespace {

// One that is off costs nothing.
Effect effect(bool on, std::string why, const EffectCost& cost) {
    if (!on) return {false, std::move(why), 0.0};
    if (!cost.cpu_seconds) why += "; " + cost.why_none;
    return {true, std::move(why), cost.cpu_seconds};
}

Effect counted(const LaunchReport& report, const std::string& name, const EffectCost& cost) {
    const long long n = counter(report, name);
    return effect(n > 0, fmt::format("{}: {}", name, n), cost);
}

// What POV-Ray itself times before it traces, which every launch does again.
Effect timed(bool on, const char* why_on, const char* why_off, double cpu_seconds) {
    return effect(on, on ? why_on : why_off, {cpu_seconds, {}});
}

Effect antialiasing(const Antialiasing& aa, const EffectCost& cost) {
    return effect(aa.on,
                  aa.on ? fmt::format("Method {}, Threshold {:.3f}, Depth {}", aa.method,
                                      aa.threshold, aa.depth)
                        : "Antialiasing Off",
                  cost);
}

Effect order_dependent(const ProbeResult& probe) {
    const bool radiosity = probe.report.radiosity;
    const EffectCost cost{{}, "it costs no tracing, but launches have one thread and a fixed grid"};
    return effect(
        probe.order_dependent || radiosity || !probe.seen_whole,
        radiosity ? "radiosity samples are taken in rendering order"
        : probe.order_dependent
            ? "small renders that differ only in their block order came out differently"
        : !probe.seen_whole
            ? "the scene cannot be rendered small, and its middle does not speak for all of it"
            : "small renders in three block orders are identical",
        cost);
}

Effect area_light(const QualityLook& look, const EffectCost& cost) {
    const char* tests = "Shadow Ray Tests";
    const long long with = counter(at_level(look, 5), tests);
    const long long without = counter(at_level(look, 4), tests);
    return effect(with != without,
                  fmt::format("{}: {} (+Q5), {} without area lights (+Q4)", tests, with, without),
                  cost);
}

Effect focal_blur(const QualityLook& look, const EffectCost& cost) {
    const double rays = camera_rays(look);
    return effect(rays > 1, fmt::format("{:.2f} rays from the camera for each pixel", rays), cost);
}

Effect subsurface(const QualityLook& look, const EffectCost& cost) {
    const LaunchReport &with = at_level(look, 9), &without = at_level(look, 8);
    for (const char* name : {"Shadow Ray Tests", "Rays"})
        if (counter(with, name) != counter(without, name))
            return effect(true,
                          fmt::format("{}: {} (+Q9), {} (+Q8), and no other effect of +Q9", name,
                                      counter(with, name), counter(without, name)),
                          cost);
    return effect(false, "+Q9 and +Q8 trace the same", cost);
}

// What +Q9 adds in tracing, where it is more than one thing or has a time of its own besides.
void share_richest(std::map<std::string, Effect>& effects, const EffectCost& richest) {
    std::vector<std::string> on;
    for (const char* name : {"media", "photons", "radiosity"})
        if (effects.at(name).on) on.emplace_back(name);
    if (!richest.cpu_seconds) return;
    for (const std::string& name : on) {
        Effect& effect = effects.at(name);
        if (on.size() > 1) {
            effect.why += fmt::format(
                "; {} take {:.3g} s of the tracing, and POV-Ray has no level "
                "between them",
                fmt::join(on, " and "), *richest.cpu_seconds);
            if (name == "media") effect.cpu_seconds.reset();
        } else if (name != "media") {
            effect.why += fmt::format("; {:.3g} s more of the tracing", *richest.cpu_seconds);
        }
    }
}

}  // namespace

std::map<std::string, Effect> find_effects(const ProbeResult& probe) {
    const LaunchReport& report = probe.report;
    const EffectCosts costs = effect_costs(probe);
    const ProbeResult sane = with_sane_times(probe);
    std::map<std::string, Effect> effects;
    effects["antialiasing"] = antialiasing(report.antialiasing, costs.antialiasing);
    effects["radiosity"] = timed(report.radiosity, "Radiosity Time is given", "No radiosity",
                                 sane.report.radiosity_cpu);
    effects["photons"] =
        timed(report.photons, "Photon Time is given", "No photons", sane.report.photon_cpu);
    effects["media"] = counted(report, "Media Samples", costs.richest);
    effects["isosurface"] =
        counted(report, "Isosurface roots",
                {{}, "what they cost is not known: POV-Ray has no switch that leaves them out"});
    const long long refracted = counter(report, "Refracted Rays");
    const long long transmitted = counter(report, "Transmitted Rays");
    effects["transparency"] =
        effect(refracted + transmitted > 0,
               fmt::format("Refracted Rays: {}, Transmitted Rays: {}", refracted, transmitted),
               costs.transparency);
    effects["reflection"] = counted(report, "Reflected Rays", costs.reflection);
    effects["order_dependent"] = order_dependent(probe);
    effects["render"] = {true, "trace time of the small render, by area and antialiasing",
                         costs.render};
    share_richest(effects, costs.richest);
    if (!probe.look) return effects;
    effects["area_light"] = area_light(*probe.look, costs.area_light);
    effects["focal_blur"] = focal_blur(*probe.look, costs.focal_blur);
    if (!report.radiosity && !report.photons && !effects.at("media").on)
        effects["subsurface"] = subsurface(*probe.look, costs.richest);
    return effects;
}

}  // namespace mpipov
