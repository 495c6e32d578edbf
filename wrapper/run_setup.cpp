#include "run_setup.h"

#include <algorithm>

namespace mpipov {
namespace {

// A launch counts as hung after this and so many times what it should take.
constexpr double timeout_base_seconds = 600, timeout_factor = 50;
constexpr int gathering_by_lane = 4;  // launches under way for each that computes

JobCommand job_command(const Options& options, const std::vector<std::string>& arguments,
                       const Probe& probe, const Plan& plan) {
    JobCommand job;
    job.povray = options.povray;
    job.user_arguments = arguments;
    job.format_arguments = section_format(probe.result.image.type);
    job.threads = plan.record.threads;
    if (plan.record.seams == Seams::halo) {
        // The reference of a halo render is the serial render in one block.
        job.block = std::max(probe.result.image.width, probe.result.image.height);
        job.threads = 1;
    }
    return job;
}

double automatic_timeout(double cpu_seconds) {
    return timeout_base_seconds + timeout_factor * cpu_seconds;
}

}  // namespace

PlanRequest plan_request(const Options& options, const MetRanks& met, int early_threads) {
    PlanRequest request;
    request.early_threads = early_threads;
    request.pools = met.pools;
    request.shape = options.shape;
    request.seams = options.seams;
    request.halo = options.halo;
    request.sections = options.sections;
    request.radiosity = options.radiosity;
    request.radiosity_passes = options.radiosity_passes;
    request.radiosity_scale = options.radiosity_scale;
    request.schedule = options.schedule;
    request.threads = options.threads;
    request.in_flight = options.in_flight;
    request.dedicated_coordinator = options.dedicated_coordinator;
    for (const RankRecord& rank : met.ranks) request.slots.push_back(rank.slots);
    return request;
}

CoordinatorSetup coordinator_setup(const Options& options,
                                   const std::vector<std::string>& arguments, const Probe& probe,
                                   const Plan& plan, const std::vector<RankRecord>& ranks) {
    CoordinatorSetup setup;
    setup.partition = plan.partition;
    setup.policy = options.schedule;
    setup.costs = plan.costs;
    setup.job = job_command(options, arguments, probe, plan);
    setup.image = {plan.record.image.width, plan.record.image.height};
    setup.ranks = ranks;
    for (std::size_t rank = 0; rank < ranks.size(); ++rank)
        setup.ranks[rank].slots = plan.slots[rank];
    setup.in_flight = plan.in_flight;
    setup.retries = options.retries;
    setup.timeout_seconds = options.timeout_seconds.value_or(
        automatic_timeout(plan.record.predicted.cpu_seconds / plan.record.sections));
    return setup;
}

GatherSetup gather_setup(const Options& options, const CoordinatorSetup& job, const Plan& plan,
                         const Probe& probe) {
    GatherSetup setup{job, plan.waves, {}, {}};
    // Shared is what one launch after the other makes, from nothing.
    if (plan.record.radiosity.how == Sharing::joined) setup.first = probe.radiosity_cache;
    setup.timeout_seconds =
        options.timeout_seconds.value_or(automatic_timeout(plan.record.predicted.cpu_seconds));
    // Launches without antialiasing that read samples are short, and idle half of their time.
    if (!options.in_flight)
        for (std::size_t rank = 0; rank < setup.job.in_flight.size(); ++rank)
            setup.job.in_flight[rank] =
                std::max(setup.job.in_flight[rank],
                         gathering_by_lane * std::max(1, plan.slots[rank] / plan.record.threads));
    return setup;
}

}  // namespace mpipov
