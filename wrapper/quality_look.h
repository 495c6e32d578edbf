// A scene at POV-Ray's quality levels, one short launch each, side by side: which of them change
// what is traced, and what each takes. These launches come after the probe, and only where somebody
// waits for the answer or the render is so long that nobody sees them.
#pragma once

#include "probe.h"
#include "probe_launches.h"
#include "probe_result.h"

#include <optional>
#include <string>
#include <vector>

namespace mpipov {

struct LookedAt {
    std::optional<QualityLook> look;  // empty: a launch failed, or not one was needed
    double cpu_seconds = 0;           // of all that was launched for it
    int launches = 0;
};

enum class LookSize {
    as_probe,  // what the probe's own renders show
    readable   // larger where those are over before POV-Ray's clock ticks
};

// `probe` is the answer of the same request. Throws Failure(Exit::interrupted).
LookedAt look_at_qualities(const ProbeRequest& request, const ProbeResult& probe, LookSize size);

// The levels below the user's own that add something.
std::vector<int> levels_below(int quality);

// Times larger than the probe's render, so that it takes long enough to be told.
double readable_scale(const ProbeResult& probe, const ImageSize& probe_size);

// Whether a run of so many predicted seconds on so many cores takes 1 % longer at most.
bool is_hardly_noticed(const ProbeResult& probe, double wall_seconds, int cores);

}  // namespace mpipov
