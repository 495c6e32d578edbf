// What a scene calls for, and the sections, schedule and threads that follow from it. Pure: the
// probe's numbers in, the plan out; no processes, no clock.
#pragma once

#include "cost_map.h"
#include "probe_result.h"
#include "run_record.h"
#include "schedule.h"
#include "section.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mpipov {

struct PlanRequest {
    std::optional<Shape> shape;  // empty: auto
    std::optional<Seams> seams;  // empty: auto
    int halo = 2;
    std::optional<int> sections;
    std::optional<Sharing> radiosity;  // empty: auto
    int radiosity_passes = 1;
    std::optional<int> radiosity_scale;  // empty: auto
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
    std::vector<GatherWave> waves;   // what gathers radiosity samples before the sections
    std::vector<double> costs;       // by section, CPU seconds; empty: nothing is known
    std::vector<int> slots;          // by rank: what it renders with; 0: nothing
    std::vector<int> in_flight;      // by rank: launches under way; the record's is the most
    bool takes_early = false;        // the one section is what the early launch renders
    std::vector<std::string> notes;  // what the user should know about the choice
};

// Throws UsageError-like std::invalid_argument, naming the option, where the request is impossible.
Plan make_plan(const PlanRequest& request, const ProbeResult& probe);

}  // namespace mpipov
