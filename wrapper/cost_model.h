// What a render costs, by the numbers of a small one. Pure.
#pragma once

#include "launch_costs.h"
#include "probe_result.h"

#include <string>
#include <vector>

namespace mpipov {

// The terms of the cost model, seconds of CPU. Sources: docs/architecture.md, "Cost model".
struct CostModel {
    double render = 0;      // tracing the whole region
    double per_launch = 0;  // paid again by every launch: parse, photons, full-frame output
    double pretrace = 0;    // of that, for radiosity samples where a launch has none to read
    double startup_wall = startup_wall_seconds;
    int early_threads = 0;  // a launch of all with so many threads has its start-up behind it

    double cpu_seconds(int sections) const { return render + sections * per_launch; }
    // Wall time of `sections` equal shares on `lanes` launches at once of `threads` threads each.
    double wall_seconds(int sections, int lanes, int threads) const;
};
// What is left to launches that read a radiosity cache.
CostModel with_cache(CostModel cost);
// A wave that makes the cache: of so many sections, which trace so much of the region.
struct WaveShare {
    int sections = 1;
    double of_render = 1;
};
Predicted gathering_cost(const CostModel& cost, const std::vector<WaveShare>& waves, int lanes,
                         int threads);
CostModel make_cost_model(const ProbeResult& probe);

// One of POV-Ray's statistics, 0 where it did not print it.
long long counter(const LaunchReport& report, const std::string& name);

// No time is less than none or longer than any render, and there is at least one pixel.
ProbeResult with_sane_times(ProbeResult probe);

}  // namespace mpipov
