#include "effect_costs.h"

#include "cost_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace mpipov {
namespace {

constexpr const char* not_asked =
    "what it costs takes more small renders, which --dry-run and long runs make";
constexpr const char* no_time =
    "what it costs is not told: the small render is over before POV-Ray's clock ticks";

// The costs of what the small render has more than another, in steps; all in its seconds.
class Steps {
  public:
    // `whole`: the small render itself; a second of it is `scale` seconds of the whole render.
    Steps(double whole, double scale) : whole_(whole), scale_(scale) {}

    void begin(double without) { reached_ = std::clamp(without, 0.0, whole_); }

    // What is new in a render that took so long.
    EffectCost next(double with) {
        const double now = std::clamp(with, reached_, whole_);
        const double cost = now - std::exchange(reached_, now);
        if (!(whole_ > 0)) return {{}, no_time};
        const double untold = untold_seconds(now);
        if (cost < untold)
            return {{},
                    fmt::format("it costs less than {:.2g} s, which small renders do not tell",
                                untold * scale_)};
        return {cost * scale_, {}};
    }

  private:
    double whole_, scale_, reached_ = 0;
};

}  // namespace

double untold_seconds(double trace_cpu) {
    constexpr double tick = 0.001, share = 0.05;
    return tick + share * trace_cpu;
}

const LaunchReport& at_level(const QualityLook& look, int level) {
    const auto above = look.plain.upper_bound(level);
    return above == look.plain.begin() ? above->second : std::prev(above)->second;
}

double camera_rays(const QualityLook& look) {
    const LaunchReport& lowest = look.plain.begin()->second;
    const auto pixels = static_cast<double>(counter(lowest, "Pixels"));
    return pixels > 0 ? static_cast<double>(counter(lowest, "Rays")) / pixels : 1;
}

EffectCosts effect_costs(const ProbeResult& given) {
    ProbeResult probe = with_sane_times(given);
    if (probe.look && probe.look->report) {
        probe.report = *probe.look->report;
        probe.plain = probe.look->plain.rbegin()->second;
        probe.probe_pixels = probe.look->pixels;
    }
    EffectCosts costs;
    costs.render = make_cost_model(probe).render;

    const double ratio =
        static_cast<double>(probe.image.region.area()) / static_cast<double>(probe.probe_pixels);
    double once = probe.plain.trace_cpu;  // each pixel
    double once_of_render = costs.render;
    costs.antialiasing.cpu_seconds = 0;
    if (probe.report.antialiasing.on) {
        once_of_render = std::min(costs.render, once * ratio);
        Steps steps(costs.render / ratio, ratio);
        steps.begin(once);
        costs.antialiasing = steps.next(costs.render / ratio);
    }

    if (!probe.look) {
        for (EffectCost* cost : {&costs.area_light, &costs.transparency, &costs.reflection,
                                 &costs.richest, &costs.focal_blur})
            cost->why_none = not_asked;
        return costs;
    }
    once = probe.look->plain.rbegin()->second.trace_cpu;
    const double rays = std::max(1.0, camera_rays(*probe.look));
    Steps steps(once, once > 0 ? once_of_render / once / rays : 0);
    const auto seconds = [&](int level) { return at_level(*probe.look, level).trace_cpu; };
    steps.begin(seconds(4));
    costs.area_light = steps.next(seconds(5));
    costs.transparency = steps.next(seconds(6));
    costs.reflection = steps.next(seconds(8));
    costs.richest = steps.next(seconds(9));
    if (once > 0)
        costs.focal_blur.cpu_seconds = once_of_render * (1 - 1 / rays);
    else
        costs.focal_blur.why_none = no_time;
    return costs;
}

}  // namespace mpipov
