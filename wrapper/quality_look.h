// A scene at POV-Ray's quality levels, one short launch each, side by side: which of them change
// what is traced, and what each takes. These launches come after the probe, and only where somebody
// waits for the answer or the render is so long that nobody sees them.
#pragma once

#include "povray_command.h"
#include "probe.h"
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

// `probe` is the answer of the same request, `scale` how many times larger than its renders these
// are to be: beside larger ones the user's own antialiasing is looked at again. A scene that was
// not seen whole has no other size. Throws Failure(Exit::interrupted).
LookedAt look_at_qualities(const ProbeRequest& request, const ProbeResult& probe, double scale);

// The levels below the user's own that add something.
std::vector<int> levels_below(int quality);

// The scale at which the renders take long enough to be told; at least 1. `probe_size` is that of
// the probe's renders.
double readable_scale(const ProbeResult& probe, const ImageSize& probe_size);

// The largest scale, at most 1, at which a run of so many predicted seconds on so many cores takes
// 1 % longer at most; none where it is noticed at any.
std::optional<double> unnoticed_scale(const ProbeResult& probe, double wall_seconds, int cores);

}  // namespace mpipov
