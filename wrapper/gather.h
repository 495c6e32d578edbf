// Makes the radiosity cache of a run before its sections: one coordinator for each wave of
// radiosity_sharing.h, over the same ranks.
#pragma once

#include "coordinator.h"
#include "journal.h"
#include "radiosity_sharing.h"
#include "run_record.h"
#include "worker.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mpipov {

struct GatherSetup {
    // The job, its ranks and how it is retried; what the image's sections are does not matter.
    CoordinatorSetup job;
    std::vector<GatherWave> waves;
    std::string first;                      // a cache that the first wave reads
    std::optional<double> timeout_seconds;  // of a launch that gathers
};

// What keeps the run: where a wave goes on from, and who is told of it.
struct GatherContext {
    Transport& transport;
    Worker& worker;
    Journal* journal = nullptr;
    std::function<double()> clock;  // seconds since the run began
    // Wave (from 0), how much of it is done (0 to 1).
    std::function<void(int wave, double fraction)> progress;
    double lost_after_seconds = 0;  // EventLoop::lost_after_seconds
};

// The joined cache, the same bits for any number of ranks, schedule and order of events. Adds the
// waves, launches and CPU seconds to `record`, and the busy seconds to `ranks`. Waves that the
// journal has kept are not made again. Throws as Coordinator::handle() and run_event_loop() do.
std::string gather_radiosity(const GatherSetup& setup, const GatherContext& context,
                             RunRecord& record, std::vector<RankRecord>& ranks);

}  // namespace mpipov
