// After the plan: more small renders say more of the effects and what they cost, where it is asked
// for or hardly noticed. The plan itself stays as it is.
#pragma once

#include "probe.h"
#include "render_job.h"
#include "run_record.h"

namespace mpipov {

// `probe` is of the same arguments, `plan` made from it; the launches count in `totals`. The
// request's folder must not exist. Throws Failure(Exit::interrupted).
void look_closer(const JobSetup& setup, const ProbeRequest& request, ProbeResult& probe,
                 PlanRecord& plan, Totals& totals);

}  // namespace mpipov
