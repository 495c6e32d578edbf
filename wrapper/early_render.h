// The whole image in one launch, started together with the probe: a render that takes about as long
// as POV-Ray's start-up would else pay that twice. Where the plan then is one launch of so
// many threads, rank 0's worker takes it; else it is stopped, having spent little more than its
// idle start-up.
#pragma once

#include "confinement.h"
#include "prepared_launch.h"
#include "render_job.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mpipov {

struct EarlyRender {
    PreparedLaunch launch;
    int threads = 1;
};

// None where the options rule out such a plan, or other hosts have ranks. `folder` must not exist.
std::optional<EarlyRender> start_early(const JobSetup& setup, int ranks,
                                       const std::vector<std::string>& arguments,
                                       const std::filesystem::path& folder,
                                       const Confinement& confinement);

}  // namespace mpipov
