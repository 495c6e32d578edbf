// What a scene calls for, and the sections, schedule and threads that follow from it. Pure: the
// probe's numbers in, the plan out; no processes, no clock.
#pragma once

#include "cost_map.h"
#include "launch_costs.h"
#include "povray_text.h"
#include "run_record.h"
#include "schedule.h"
#include "section.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mpipov {

// What the small probe renders said.
struct ProbeResult {
    ImageOptions image;            // of the whole render, as POV-Ray resolved it
    LaunchReport report;           // of the small render
    long long probe_pixels = 1;    // how many pixels the small render had
    bool order_dependent = false;  // the small render came out differently in another block order
    bool seen_whole = true;        // false: it showed the middle of the picture only
    int user_block = 0;            // the user's own +BS, 0: POV-Ray's default
    ImageInfo stored;              // type, depth and channels of the file that POV-Ray wrote
};

struct PlanRequest {
    std::optional<Shape> shape;  // empty: auto
    std::optional<Seams> seams;  // empty: auto
    int halo = 2;
    std::optional<int> sections;
    Policy schedule = Policy::dynamic;
    std::optional<int> threads;
    std::optional<int> in_flight;
    std::vector<int> slots;  // cores of each rank, 0 for one that renders nothing
    // Cores that a rank may use where the other ranks of its host render nothing; 0 for those
    // others. Empty: every rank keeps to its slots.
    std::vector<int> pools;
    bool dedicated_coordinator = false;
    // What the parts of the region cost, with Policy::cost; empty: nothing is known.
    std::optional<CostMap> costs;
    // A launch of the whole image with so many threads is under way already, 0: none.
    int early_threads = 0;
};

struct Plan {
    PlanRecord record;
    Partition partition;
    std::vector<double> costs;       // by section, CPU seconds; empty: nothing is known
    std::vector<int> slots;          // by rank: what it renders with; 0: nothing
    std::vector<int> in_flight;      // by rank: launches under way; the record's is the most
    bool takes_early = false;        // the one section is what the early launch renders
    std::vector<std::string> notes;  // what the user should know about the choice
};

// Throws UsageError-like std::invalid_argument, naming the option, where the request is impossible.
Plan make_plan(const PlanRequest& request, const ProbeResult& probe);

// The terms of the cost model, seconds of CPU. Sources: docs/architecture.md, "Cost model".
struct CostModel {
    double render = 0;      // tracing the whole region
    double per_launch = 0;  // paid again by every launch: parse, photons, full-frame output
    double startup_wall = startup_wall_seconds;
    int early_threads = 0;  // a launch of all with so many threads has its start-up behind it

    double cpu_seconds(int sections) const { return render + sections * per_launch; }
    // Wall time of `sections` equal shares on `lanes` launches at once of `threads` threads each.
    double wall_seconds(int sections, int lanes, int threads) const;
};
CostModel make_cost_model(const ProbeResult& probe);

}  // namespace mpipov
