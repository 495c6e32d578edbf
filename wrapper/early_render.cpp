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
                                       const std::filesystem::path& folder) {
    const Options& options = setup.options;
    if (!could_be_one_launch(options) || setup.ranks_of_host != ranks) return {};
    JobCommand job;
    job.povray = options.povray;
    job.user_arguments = arguments;
    job.threads = options.threads.value_or(setup.pool0);
    LaunchFolder own(folder);
    ChildRequest request;
    request.argv = whole_command(job, own.path() / section_image_name);
    request.environment = temporary_files_in(own.path());
    return EarlyRender{{std::move(own), ChildProcess::start(request)}, job.threads};
}

}  // namespace mpipov
