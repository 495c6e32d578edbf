#include "cost_model.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mpipov {
namespace {

// Longer than any render; what is no time at all counts as none.
constexpr double longest_seconds = 1e12;

double sane(double seconds) {
    return seconds > 0 ? std::min(seconds, longest_seconds) : 0;
}

// How many small renders fit into the region.
double area_ratio(const ProbeResult& probe) {
    return static_cast<double>(probe.image.region.area()) / static_cast<double>(probe.probe_pixels);
}

// What antialiasing takes of a small render is more than it takes of a large one: what differs from
// its neighbour is mostly edges, and an image of twice the size has half of them for each pixel.
// Textures have as many, so the truth lies between: samples a pixel go with the square root of the
// size, within a factor of 2.3 in all of eight scenes measured at 30 x 22 and 480 x 360 pixels
// (docs/architecture.md).
double antialiasing_factor(const ProbeResult& probe) {
    const double pixels = static_cast<double>(counter(probe.report, "Pixels"));
    const double samples = static_cast<double>(counter(probe.report, "Samples"));
    if (!probe.seen_whole || pixels <= 0 || samples <= 0) return 1;
    const double image = static_cast<double>(probe.image.width) * probe.image.height;
    const double size = std::sqrt(image / static_cast<double>(probe.probe_pixels));
    if (size <= 1) return 1;
    // The small render's blocks are small, and method 1 renders their edges twice.
    const double once = std::min(pixels, static_cast<double>(probe.probe_pixels));
    return (once + samples / std::sqrt(size)) / (pixels + samples);
}

double render_cpu(const ProbeResult& probe) {
    return probe.report.trace_cpu * area_ratio(probe) * antialiasing_factor(probe);
}

}  // namespace

long long counter(const LaunchReport& report, const std::string& name) {
    const auto found = report.counters.find(name);
    return found == report.counters.end() ? 0 : found->second;
}

ProbeResult with_sane_times(ProbeResult probe) {
    std::vector<LaunchReport*> reports{&probe.report, &probe.plain};
    if (probe.look) {
        if (probe.look->report) reports.push_back(&*probe.look->report);
        for (auto& [level, report] : probe.look->plain) reports.push_back(&report);
        probe.look->pixels = std::max(1LL, probe.look->pixels);
    }
    for (LaunchReport* report : reports)
        for (double* seconds :
             {&report->parse_cpu, &report->photon_cpu, &report->radiosity_cpu, &report->trace_cpu})
            *seconds = sane(*seconds);
    probe.probe_pixels = std::max(1LL, probe.probe_pixels);
    return probe;
}

double CostModel::wall_seconds(int sections, int lanes, int threads) const {
    const double share = render / sections / threads + per_launch;
    const double work = share * std::ceil(static_cast<double>(sections) / lanes);
    // Shares are never equal: half of one is lost at the end where several lanes must meet. A
    // launch's own threads share by small blocks and lose next to nothing.
    const double imbalance = lanes > 1 ? render / sections / threads / 2 : 0;
    const bool early = sections == 1 && threads == early_threads;
    return (early ? 0 : startup_wall) + work + imbalance;
}

CostModel with_cache(CostModel cost) {
    cost.per_launch -= cost.pretrace;
    cost.pretrace = 0;
    return cost;
}

Predicted gathering_cost(const CostModel& cost, const std::vector<WaveShare>& waves, int lanes,
                         int threads) {
    Predicted sum;
    for (const WaveShare& wave : waves) {
        CostModel part = cost;
        part.early_threads = 0;
        part.render *= wave.of_render;
        sum.wall_seconds +=
            part.wall_seconds(wave.sections, std::min(lanes, wave.sections), threads);
        sum.cpu_seconds += part.cpu_seconds(wave.sections);
    }
    return sum;
}

CostModel make_cost_model(const ProbeResult& given) {
    const ProbeResult probe = with_sane_times(given);
    CostModel cost;
    const LaunchReport& report = probe.report;
    const double frame = static_cast<double>(probe.image.width) * probe.image.height;
    cost.render = render_cpu(probe);
    cost.per_launch = bare_launch_cpu_seconds + report.parse_cpu + report.photon_cpu +
                      frame_pixel_cpu_seconds * frame;
    // The pretrace looks at the section only, but it must light that section's surroundings too:
    // nearly all of it is paid again.
    if (report.radiosity) cost.pretrace = report.radiosity_cpu;
    cost.per_launch += cost.pretrace;
    return cost;
}

}  // namespace mpipov
