#include "closer_look.h"

#include "probe_launches.h"
#include "quality_look.h"
#include "scene_effects.h"

#include <optional>
#include <utility>

namespace mpipov {

void look_closer(const JobSetup& setup, const ProbeRequest& request, ProbeResult& probe,
                 PlanRecord& plan, Totals& totals) {
    const Options& options = setup.options;
    std::optional<double> scale;
    if (options.dry_run)
        scale = readable_scale(probe, small_view(request.user_arguments).size);
    else if (!options.resume)  // of a run that goes on from a journal little may be left
        scale = unnoticed_scale(probe, plan.predicted.wall_seconds, setup.pool0);
    if (!scale) return;
    const LookedAt looked = look_at_qualities(request, probe, *scale);
    totals.cpu_seconds += looked.cpu_seconds;
    totals.launches += looked.launches;
    probe.look = looked.look;
    plan.effects = find_effects(probe);
}

}  // namespace mpipov
