// Where the costs of a scene's parts come from, for --schedule cost: the record of an earlier run
// of the same scene, or small renders of its parts.
#pragma once

#include "cost_map.h"
#include "probe.h"

#include <filesystem>
#include <optional>
#include <string>

namespace mpipov {

// From the record that an earlier run left in `file`, of the same scene files (any size and
// options, the same part of the picture): where the costs lie is the record's, their sum the
// probe's. None where there is no such record.
std::optional<CostMap> costs_of_earlier_run(const std::filesystem::path& file,
                                            const std::string& scene_sha1,
                                            const ProbeResult& probe);

// Renders the parts of the small picture by themselves and takes POV-Ray's CPU times. Parts that
// cannot be rendered, or not in time, cost as much as the dearest. Throws
// Failure(Exit::interrupted).
struct PartCosts {
    CostMap costs;
    double cpu_seconds = 0;  // of all that was launched for it
    int launches = 0;
};
PartCosts costs_of_small_parts(const ProbeRequest& request, const ProbeResult& probe);

}  // namespace mpipov
