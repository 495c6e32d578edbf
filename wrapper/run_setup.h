// What the parts of a run are set up with, from the command line, the ranks, the probe and the
// plan. Pure.
#pragma once

#include "coordinator.h"
#include "gather.h"
#include "options.h"
#include "probe.h"
#include "scene_plan.h"

#include <string>
#include <vector>

namespace mpipov {

struct MetRanks {
    std::vector<RankRecord> ranks;
    std::vector<int> pools;          // PlanRequest::pools
    std::vector<std::string> views;  // point_of_view() of each
};

PlanRequest plan_request(const Options& options, const MetRanks& met, int early_threads);

// `arguments` are POV-Ray's, quoted as it wants them.
CoordinatorSetup coordinator_setup(const Options& options,
                                   const std::vector<std::string>& arguments, const Probe& probe,
                                   const Plan& plan, const std::vector<RankRecord>& ranks);

// `job`: that of the image. The probe's small render of the whole picture was a first coarse pass.
GatherSetup gather_setup(const Options& options, const CoordinatorSetup& job, const Plan& plan,
                         const Probe& probe);

}  // namespace mpipov
