#include "early_render.h"

#include "povray_command.h"
#include "worker.h"

#include <utility>

namespace mpipov {
namespace {

bool could_be_one_launch(const Options& options) {
    return !options.dry_run && !options.resume && !options.dedicated_coordinator &&
           options.schedule != Policy::static_ && options.sections.value_or(1) == 1 &&
           options.seams.value_or(Seams::aligned) != Seams::halo;
}

}  // namespace

std::optional<EarlyRender> start_early(const JobSetup& setup, int ranks,
                                       const std::vector<std::string>& arguments,
                                       const std::filesystem::path& folder,
                                       const Confinement& confinement) {
    const Options& options = setup.options;
    if (!could_be_one_launch(options) || setup.ranks_of_host != ranks) return {};
    JobCommand job;
    job.povray = options.povray;
    job.user_arguments = arguments;
    job.threads = options.threads.value_or(setup.pool0);
    LaunchFolder own(folder);
    LaunchNeeds needs;
    needs.argv = whole_command(job, own.path() / section_image_name);
    needs.folder = own.path();
    needs.threads = job.threads;
    needs.pixels.reset();
    return EarlyRender{{std::move(own), ChildProcess::start(confinement.request(std::move(needs)))},
                       job.threads};
}

}  // namespace mpipov
