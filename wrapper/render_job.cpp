#include "render_job.h"

#include "coordinator.h"
#include "cpu_time.h"
#include "event_loop.h"
#include "failure.h"
#include "output_place.h"
#include "probe.h"
#include "progress.h"
#include "scene_plan.h"
#include "scratch.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>

namespace mpipov {
namespace {

// How long ranks may take to come up after rank 0 did.
constexpr double hello_seconds = 60;
// A launch counts as hung after this and so many times what it should take.
constexpr double timeout_base_seconds = 600, timeout_factor = 50;

class RunClock {
  public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    }

  private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

std::vector<RankRecord> meet_ranks(const JobSetup& setup, Transport& transport,
                                   const std::string& povray) {
    std::vector<RankRecord> ranks(static_cast<std::size_t>(transport.size()));
    ranks[0] = setup.rank0;
    for (int missing = transport.size() - 1; missing > 0; --missing) {
        const auto message = wait_for_message(transport, hello_seconds);
        if (!message)
            throw Failure(Exit::interrupted, fmt::format("{} ranks did not come up within {:.0f} s",
                                                         missing, hello_seconds));
        const nlohmann::json& head = message->head;
        const auto host = head.at("host").get<std::string>();
        if (message->kind == MessageKind::refused)
            throw Failure(static_cast<Exit>(head.at("code").get<int>()),
                          fmt::format("host {}: {}", host, head.at("why").get<std::string>()));
        if (head.at("povray") != povray)
            throw Failure(Exit::scene,
                          fmt::format("host {} has POV-Ray {} and rank 0 has {}: their pixels "
                                      "could differ",
                                      host, head.at("povray").get<std::string>(), povray));
        ranks.at(static_cast<std::size_t>(message->peer)) = {message->peer, host, head.at("slots"),
                                                             0, 0};
    }
    if (setup.options.dedicated_coordinator) ranks[0].slots = 0;
    return ranks;
}

PlanRequest plan_request(const Options& options, const std::vector<RankRecord>& ranks) {
    PlanRequest request;
    request.shape = options.shape;
    request.seams = options.seams;
    request.halo = options.halo;
    request.sections = options.sections;
    request.schedule = options.schedule;
    request.threads = options.threads;
    request.in_flight = options.in_flight;
    request.dedicated_coordinator = options.dedicated_coordinator;
    for (const RankRecord& rank : ranks) request.slots.push_back(rank.slots);
    return request;
}

// The grid of the run that is resumed, whatever this one would have chosen.
void take_grid(Plan& plan, const nlohmann::json& earlier) {
    const PlanRecord record = plan_from_json(earlier);
    plan.record.shape = record.shape;
    plan.record.seams = record.seams;
    plan.record.halo = record.halo;
    plan.record.block = record.block;
    plan.record.sections = record.sections;
    plan.partition = make_partition(
        {record.region, record.shape, record.seams, record.sections, record.halo, record.block});
}

nlohmann::json identity_of(const Probe& probe, const std::vector<std::string>& arguments,
                           const std::string& povray) {
    const ImageOptions& image = probe.result.image;
    return {{"scene", sha1_of_file(image.input_file)},
            {"arguments", arguments},
            {"POV-Ray version", povray},
            {"image size", {image.width, image.height}}};
}

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

}  // namespace

void run_job(const JobSetup& setup, Transport& transport, Worker& worker) {
    const Options& options = setup.options;
    if (options.povray_arguments.empty())
        throw Failure(Exit::usage, "no scene is given: mpipov SCENE.pov [POV-Ray's own options]");
    const RunClock clock;
    RunRecord record;
    record.started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
    record.command = setup.command;
    record.versions = setup.versions;

    const std::string povray = povray_version(options.povray);
    record.versions["povray"] = povray;
    const std::vector<std::string> arguments = quote_arguments(options.povray_arguments);
    const ScratchFolder scratch("probe");
    const Probe probe =
        run_probe({options.povray, arguments, scratch.path() / "probe", options.timeout_seconds});
    record.totals.cpu_seconds = probe.cpu_seconds;
    record.totals.launches = probe.launches;
    record.warnings = probe.warnings;

    const OutputPlace place(probe.result.image.output_file, options.record, options.work_dir);
    const std::vector<RankRecord> ranks = meet_ranks(setup, transport, povray);
    Plan plan;
    try {
        plan = make_plan(plan_request(options, ranks), probe.result);
    } catch (const std::invalid_argument& error) {
        throw Failure(Exit::usage, error.what());
    }
    if (options.dry_run) {
        fmt::print("{}\n", to_json(plan.record).dump(2));
        return;
    }
    place.check();

    std::optional<Journal> journal;
    const nlohmann::json identity = identity_of(probe, arguments, povray);
    if (options.resume) {
        journal = Journal::open(place.work_folder(), identity);
        take_grid(plan, journal->plan());
    } else if (plan.record.sections > 1) {
        journal = Journal::create(place.work_folder(), identity, to_json(plan.record));
    }
    record.plan = plan.record;
    record.output = place.image();

    Canvas canvas({plan.record.image.width, plan.record.image.height, plan.record.image.channels,
                   depth_from_string(plan.record.image.depth)});
    canvas.make_opaque_outside(plan.record.region);
    CoordinatorSetup coordination;
    coordination.partition = plan.partition;
    coordination.policy = options.schedule;
    coordination.job = job_command(options, arguments, probe, plan);
    coordination.image = {plan.record.image.width, plan.record.image.height};
    coordination.ranks = ranks;
    coordination.in_flight = plan.record.in_flight;
    coordination.retries = options.retries;
    coordination.timeout_seconds = options.timeout_seconds.value_or(
        timeout_base_seconds +
        timeout_factor * plan.record.predicted.cpu_seconds / plan.record.sections);
    Coordinator coordinator(std::move(coordination), transport, canvas,
                            journal ? &*journal : nullptr, [&clock] { return clock.seconds(); });

    ProgressView progress(options.progress);
    for (const std::string& warning : probe.warnings) progress.say("POV-Ray: " + warning);
    for (const std::string& note : plan.notes) progress.say("mpipov: " + note);
    try {
        if (options.resume) {
            int resumed = 0;
            for (const Journal::Finished& finished : journal->finished()) {
                coordinator.resume(finished.section, finished.about,
                                   journal->read(finished.section));
                ++resumed;
            }
            progress.inform(fmt::format("mpipov: {} of {} sections were finished before", resumed,
                                     plan.record.sections));
        }
        coordinator.start();
        run_event_loop({transport, worker, &coordinator, [&] {
                            progress.update(coordinator.fraction(), coordinator.sections_done(),
                                            coordinator.sections_total(), clock.seconds());
                        }});
    } catch (const Failure& failure) {
        if (coordinator.sections_done() == 0) {
            if (journal && !options.resume) journal->remove();
            throw;
        }
        if (!journal) throw;
        throw Failure(failure.code(),
                      fmt::format("{}; {} of {} sections are kept in '{}': go on with --resume",
                                  failure.what(), coordinator.sections_done(),
                                  coordinator.sections_total(), journal->folder().string()));
    }
    progress.finish(coordinator.sections_total(), clock.seconds());
    coordinator.place_repairs();

    place.write([&](const std::filesystem::path& file) { write_image(canvas, probe.style, file); });
    coordinator.fill(record);
    for (const std::string& warning : record.warnings)
        if (std::find(probe.warnings.begin(), probe.warnings.end(), warning) ==
            probe.warnings.end())
            progress.say("POV-Ray: " + warning);
    record.complete = true;
    record.pixel_sha1 = canvas.sha1();
    record.totals.wall_seconds = clock.seconds();
    record.totals.coordinator_cpu_seconds = own_cpu_seconds(RUSAGE_SELF);
    try {
        write_run_record(place.record(), record);
    } catch (const std::runtime_error& error) {
        throw Failure(Exit::file, error.what());
    }
    if (journal) journal->remove();
}

}  // namespace mpipov
