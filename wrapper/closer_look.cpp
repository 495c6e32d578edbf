#include "closer_look.h"

#include "quality_look.h"
#include "scene_effects.h"

#include <utility>

namespace mpipov {

void look_closer(const JobSetup& setup, const std::vector<std::string>& arguments,
                 const std::filesystem::path& folder, ProbeResult& probe, PlanRecord& plan,
                 Totals& totals) {
    const Options& options = setup.options;
    const auto is_long = [&] {  // a run that goes on from a journal may have little left to do
        return !options.resume &&
               is_hardly_noticed(probe, plan.predicted.wall_seconds, setup.pool0);
    };
    if (!options.dry_run && !is_long()) return;
    LookedAt looked =
        look_at_qualities({options.povray, arguments, folder, options.timeout_seconds}, probe,
                          options.dry_run ? LookSize::readable : LookSize::as_probe);
    totals.cpu_seconds += looked.cpu_seconds;
    totals.launches += looked.launches;
    probe.look = std::move(looked.look);
    plan.effects = find_effects(probe);
}

}  // namespace mpipov
