// Which effects a scene calls for, why, and what they cost, by what POV-Ray printed of the probe's
// renders. Pure.
#pragma once

#include "probe_result.h"
#include "run_record.h"

#include <map>
#include <string>

namespace mpipov {

// By name: antialiasing, radiosity, photons, ...; `render` is what tracing costs. One that was not
// asked for (ProbeResult::look) is not there: area_light, focal_blur, subsurface. So is subsurface
// where it cannot be told from other effects.
std::map<std::string, Effect> find_effects(const ProbeResult& probe);

}  // namespace mpipov
