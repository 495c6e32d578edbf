#include "render_job.h"

#include "closer_look.h"
#include "coordinator.h"
#include "cost_model.h"
#include "cost_source.h"
#include "cpu_time.h"
#include "early_render.h"
#include "event_loop.h"
#include "failure.h"
#include "gather.h"
#include "image_library.h"
#include "interrupt.h"
#include "job_identity.h"
#include "meet_ranks.h"
#include "other_file.h"
#include "output_bounds.h"
#include "output_place.h"
#include "probe.h"
#include "progress.h"
#include "resume.h"
#include "run_setup.h"
#include "scene_plan.h"
#include "scene_view.h"
#include "scratch.h"
#include "ship_scene.h"
#include "standard_output.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <optional>
#include <stdexcept>

namespace mpipov {
namespace {

// Seconds of tracing from which it pays to look at the parts of the picture first.
constexpr double least_render_to_look_at = 20;

class RunClock {
  public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    }

  private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

Plan checked_plan(const PlanRequest& request, const ProbeResult& probe) {
    try {
        return make_plan(request, probe);
    } catch (const std::invalid_argument& error) {
        throw Failure(Exit::usage, error.what());
    }
}

Canvas make_canvas(const PlanRecord& plan) {
    const PixelLayout layout{plan.image.width, plan.image.height, plan.image.channels,
                             depth_from_string(plan.image.depth)};
    try {
        Canvas canvas(layout);
        canvas.make_opaque_outside(plan.region);
        return canvas;
    } catch (const std::runtime_error&) {
        constexpr double gib = 1 << 30;
        throw Failure(
            Exit::file,
            fmt::format("no memory for the image: rank 0 keeps its {} x {} pixels, {:.1f} GiB",
                        layout.width, layout.height,
                        static_cast<double>(layout.row_bytes()) * layout.height / gib));
    }
}

std::optional<Journal> begin_journal(const Options& options, const OutputPlace& place,
                                     const nlohmann::json& identity, const Plan& plan) {
    if (options.resume) return Journal::open(place.work_folder(), identity);
    if (plan.record.sections == 1 && plan.waves.empty()) return {};
    return Journal::create(place.work_folder(), identity, to_json(plan.record));
}

// So that every rank can render. What the settings name and a scene may not read (an INI file
// beside it is the scene's) is not sent: it would be the scene's there.
Shipping bring_scene_to_all(const Options& options, const std::vector<std::string>& arguments,
                            const Probe& probe, const MetRanks& met, const Confinement& confinement,
                            Transport& transport) {
    ShipRequest request{
        options.ship,
        scene_request(probe, arguments),
        arguments,
        [&](const std::filesystem::path& file) { return confinement.is_users(file); },
        {}};
    std::erase_if(request.scene.library_paths,
                  [&](const auto& path) { return !confinement.may_read(path); });
    // A radiosity cache of the user's, which the scene does not name.
    if (probe.result.own_cache)
        for (const auto& [key, value] : probe.settings)
            if (key == "Radiosity_File_Name" && confinement.may_read(value))
                request.scene.options.push_back(fmt::format("+I\"{}\"", value));
    for (std::size_t rank = 0; rank < met.ranks.size(); ++rank)
        request.ranks.push_back({met.ranks[rank].host, met.views[rank]});
    return ship_scene(request, transport);
}

// What it costs to know is part of the run.
std::optional<CostMap> find_costs(const ProbeRequest& request, const Probe& probe,
                                  const OutputPlace& place, RunRecord& record) {
    if (auto costs = costs_of_earlier_run(place.record(), record.scene_sha1, probe.result))
        return costs;
    if (make_cost_model(probe.result).render < least_render_to_look_at) return {};
    if (!probe.result.seen_whole) return {};  // its parts refuse to be small too
    PartCosts parts = costs_of_small_parts(request, probe.result);
    record.totals.cpu_seconds += parts.cpu_seconds;
    record.totals.launches += parts.launches;
    return std::move(parts.costs);
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

    const std::vector<std::string> arguments = quote_arguments(options.povray_arguments);
    const ScratchFolder scratch("probe");
    std::optional<EarlyRender> early = start_early(
        setup, transport.size(), arguments, worker.scratch() / "early", worker.confinement());
    const auto stop_early = [&] {
        if (!early) return;
        record.totals.cpu_seconds += early->launch.child.cpu_seconds();
        ++record.totals.launches;
        early.reset();
    };
    const auto look = [&](const char* folder) {
        return ProbeRequest{options.povray,          arguments, scratch.path() / folder,
                            options.timeout_seconds, {},        worker.confinement()};
    };
    std::optional<LoadingImageLibrary> loading;
    if (!options.dry_run) loading.emplace();
    ProbeRequest probing = look("probe");
    // It would take the probe's cores, and radiosity is hardly ever one launch.
    probing.at_radiosity = stop_early;
    Probe probe = run_probe(probing);
    const std::string& povray = probe.povray;
    record.versions["povray"] = povray;
    record.totals.cpu_seconds += probe.cpu_seconds;
    record.totals.launches += probe.launches;
    record.warnings = probe.warnings;

    const OutputPlace place(probe.result.image.output_file, options.record, options.work_dir);
    require_within_bounds(place, options, request_of_user(options.povray_arguments));
    MetRanks met = meet_ranks(setup.rank0, setup.pool0, transport, povray);
    if (options.dedicated_coordinator) met.ranks[0].slots = 0;
    if (!section_format(probe.result.image.type).empty()) stop_early();
    const nlohmann::json identity = job_identity(probe, arguments, povray);
    record.scene_sha1 = scene_sha1(identity);
    std::vector<std::filesystem::path> kept = files_of_scene(identity);
    kept.push_back(place.image());
    require_other_file("--record", place.record(), kept);
    PlanRequest request = plan_request(options, met, early ? early->threads : 0);
    Plan plan = checked_plan(request, probe.result);
    // One launch has no parts to weigh against each other.
    if (options.schedule == Policy::cost && !plan.takes_early && !options.resume) {
        stop_early();
        request.early_threads = 0;
        request.costs = find_costs(look("parts"), probe, place, record);
        plan = checked_plan(request, probe.result);
    }
    look_closer(setup, look("look"), probe.result, plan.record, record.totals);
    if (early && plan.takes_early) {
        worker.adopt(0, std::move(early->launch));
        early.reset();
    }
    stop_early();
    if (options.dry_run) {
        print_result(to_json(plan.record).dump(2) + '\n');
        return;
    }
    place.check();

    Canvas canvas = make_canvas(plan.record);
    const Shipping shipping =
        bring_scene_to_all(options, arguments, probe, met, worker.confinement(), transport);
    std::optional<Journal> journal = begin_journal(options, place, identity, plan);
    std::optional<Coordinator> coordinator;
    try {
        if (options.resume) take_grid(plan, *journal, options);
        record.plan = plan.record;
        record.output = place.image();
        const auto now = [&clock] { return clock.seconds(); };
        // On one host mpiexec itself sees it, and a busy machine must not look like a lost one.
        const double lost_after_seconds =
            setup.ranks_of_host == transport.size() ? 0 : options.lost_after_seconds;
        ProgressView progress(options.progress);
        for (const std::string& warning : probe.warnings) progress.say("POV-Ray: " + warning);
        for (const std::string& note : plan.notes) progress.say("mpipov: " + note);
        if (const std::string note = worker.confinement().note(); !note.empty())
            progress.inform("mpipov: " + note);
        if (!shipping.hosts.empty())
            progress.inform(fmt::format("mpipov: sent the scene ({} files, {:.1f} MB) to {}",
                                        shipping.files, static_cast<double>(shipping.bytes) * 1e-6,
                                        fmt::join(shipping.hosts, ", ")));
        CoordinatorSetup job = coordinator_setup(options, arguments, probe, plan, met.ranks);
        job.shipped = shipping.scene;
        if (!plan.waves.empty())
            job.cache = gather_radiosity(gather_setup(options, job, plan, probe),
                                         {transport, worker, journal ? &*journal : nullptr, now,
                                          [&](int wave, double fraction) {
                                              progress.update_gathering(
                                                  wave + 1, static_cast<int>(plan.waves.size()),
                                                  fraction, clock.seconds());
                                          },
                                          lost_after_seconds},
                                         record, job.ranks);
        progress.begin_image(clock.seconds());
        coordinator.emplace(std::move(job), transport, canvas, journal ? &*journal : nullptr, now);
        if (options.resume)
            progress.inform(fmt::format("mpipov: {} of {} sections were finished before",
                                        take_finished_sections(*coordinator, *journal),
                                        plan.record.sections));
        coordinator->start();
        run_event_loop({transport, worker, &*coordinator,
                        [&] {
                            progress.update(coordinator->fraction(), coordinator->sections_done(),
                                            coordinator->sections_total(), clock.seconds());
                        },
                        lost_after_seconds});
        progress.finish(coordinator->sections_total(), clock.seconds());
        coordinator->place_repairs();

        place.write(
            [&](const std::filesystem::path& file) { write_image(canvas, probe.style, file); });
        coordinator->fill(record);
        for (const std::string& warning : record.warnings)
            if (std::find(probe.warnings.begin(), probe.warnings.end(), warning) ==
                probe.warnings.end())
                progress.say("POV-Ray: " + warning);
        record.complete = true;
        record.pixel_sha1 = canvas.sha1();
        record.totals.wall_seconds = clock.seconds();
        record.totals.coordinator_cpu_seconds = own_cpu_seconds(RUSAGE_SELF);
        write_run_record(place.record(), record);
    } catch (const std::exception& error) {
        throw end_of_run(error, journal ? &*journal : nullptr,
                         coordinator ? &*coordinator : nullptr, options.resume);
    }
    if (journal) journal->remove();
}

}  // namespace mpipov
