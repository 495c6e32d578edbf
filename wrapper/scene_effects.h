// Which effects a scene calls for, by what POV-Ray printed of the probe's renders. Pure.
#pragma once

#include "probe_result.h"
#include "run_record.h"

#include <map>
#include <string>

namespace mpipov {

// By name: antialiasing, radiosity, photons, ...; `render` is what tracing costs.
std::map<std::string, Effect> find_effects(const ProbeResult& probe);

}  // namespace mpipov
