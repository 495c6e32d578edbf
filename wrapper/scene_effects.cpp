#include "scene_effects.h"

#include "cost_model.h"

#include <fmt/format.h>

namespace mpipov {
namespace {

Effect counted(const LaunchReport& report, const std::string& name) {
    const long long n = counter(report, name);
    return {n > 0, fmt::format("{}: {}", name, n), {}};
}

}  // namespace

std::map<std::string, Effect> find_effects(const ProbeResult& probe) {
    const LaunchReport& report = probe.report;
    std::map<std::string, Effect> effects;
    const Antialiasing& aa = report.antialiasing;
    effects["antialiasing"] = {aa.on,
                               aa.on ? fmt::format("Method {}, Threshold {:.3f}, Depth {}",
                                                   aa.method, aa.threshold, aa.depth)
                                     : "Antialiasing Off",
                               {}};
    effects["radiosity"] = {report.radiosity,
                            report.radiosity ? "Radiosity Time is given" : "No radiosity",
                            report.radiosity ? std::optional(report.radiosity_cpu) : std::nullopt};
    effects["photons"] = {report.photons, report.photons ? "Photon Time is given" : "No photons",
                          report.photons ? std::optional(report.photon_cpu) : std::nullopt};
    effects["media"] = counted(report, "Media Samples");
    effects["isosurface"] = counted(report, "Isosurface roots");
    const long long refracted = counter(report, "Refracted Rays");
    const long long transmitted = counter(report, "Transmitted Rays");
    effects["transparency"] = {
        refracted + transmitted > 0,
        fmt::format("Refracted Rays: {}, Transmitted Rays: {}", refracted, transmitted),
        {}};
    effects["reflection"] = counted(report, "Reflected Rays");
    effects["order_dependent"] = {
        probe.order_dependent || report.radiosity || !probe.seen_whole,
        report.radiosity ? "radiosity samples are taken in rendering order"
        : probe.order_dependent
            ? "small renders that differ only in their block order came out differently"
        : !probe.seen_whole
            ? "the scene cannot be rendered small, and its middle does not speak for all of it"
            : "small renders in three block orders are identical",
        {}};
    effects["render"] = {true, "trace time of the small render, by area and antialiasing",
                         make_cost_model(probe).render};
    return effects;
}

}  // namespace mpipov
