#include "resume.h"

#include <fmt/format.h>

#include <new>
#include <stdexcept>
#include <string>

namespace mpipov {
namespace {

std::string to_text(Seams seams, int halo) {
    return seams == Seams::halo ? fmt::format("halo:{}", halo) : std::string(to_string(seams));
}

void require_same(const Journal& journal, const char* option, const std::string& asked,
                  const std::string& earlier) {
    if (asked == earlier) return;
    throw Failure(Exit::usage,
                  fmt::format("--resume: {0} {1} is asked for, and the run that '{3}' belongs to "
                              "has {0} {2}; leave {0} out, or run without --resume",
                              option, asked, earlier, journal.folder().string()));
}

PlanRecord plan_of(const Journal& journal) {
    try {
        return plan_from_json(journal.plan());
    } catch (const std::exception& error) {
        throw Failure(Exit::file, fmt::format("the journal in '{}' is damaged ({}); run without "
                                              "--resume",
                                              journal.folder().string(), error.what()));
    }
}

Failure as_failure(const std::exception& error) {
    if (const auto* failure = dynamic_cast<const Failure*>(&error)) return *failure;
    if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr)
        return {Exit::file, "rank 0 is out of memory"};
    return {Exit::interrupted, error.what()};
}

}  // namespace

void take_grid(Plan& plan, const Journal& journal, const Options& options) {
    const PlanRecord earlier = plan_of(journal);
    if (options.shape)
        require_same(journal, "--shape", std::string(to_string(*options.shape)),
                     std::string(to_string(earlier.shape)));
    if (options.seams)
        require_same(journal, "--seams", to_text(*options.seams, options.halo),
                     to_text(earlier.seams, earlier.halo));
    if (options.sections)
        require_same(journal, "--sections", fmt::format("{}", *options.sections),
                     fmt::format("{}", earlier.sections));
    // The plan's own, which is what was asked for as far as the scene calls for it.
    if (options.radiosity)
        require_same(journal, "--radiosity", describe(plan.record.radiosity),
                     describe(earlier.radiosity));
    else if (options.radiosity_scale && earlier.radiosity.how != Sharing::independent)
        require_same(journal, "--radiosity-scale", fmt::format("{}", *options.radiosity_scale),
                     fmt::format("{}", earlier.radiosity.scale));
    plan.record.shape = earlier.shape;
    plan.record.seams = earlier.seams;
    plan.record.halo = earlier.halo;
    plan.record.block = earlier.block;
    plan.record.sections = earlier.sections;
    plan.record.cuts = earlier.cuts;
    plan.costs.clear();  // they are those of other sections
    const GridRequest grid{earlier.region,   earlier.shape, earlier.seams,
                           earlier.sections, earlier.halo,  earlier.block};
    plan.record.radiosity = earlier.radiosity;
    plan.partition = earlier.cuts.empty() ? make_partition(grid) : partition_of(grid, earlier.cuts);
    plan.waves = gather_waves(earlier.radiosity, {earlier.image.width, earlier.image.height},
                              plan.partition);
}

int take_finished_sections(Coordinator& coordinator, const Journal& journal) {
    const auto finished =
        journal.finished([&coordinator](int section) { return coordinator.bytes_of(section); });
    for (const Journal::Finished& section : finished)
        coordinator.resume(section.section, section.about, journal.read(section.section));
    return static_cast<int>(finished.size());
}

Failure end_of_run(const std::exception& error, Journal* journal, const Coordinator* coordinator,
                   bool resumed) {
    Failure failure = as_failure(error);
    const int done = coordinator != nullptr ? coordinator->sections_done() : 0;
    if (journal == nullptr) return failure;
    if (done > 0)
        return {failure.code(),
                fmt::format("{}; {} of {} sections are kept in '{}': go on with --resume",
                            failure.what(), done, coordinator->sections_total(),
                            journal->folder().string()),
                failure.rank_lost()};
    if (const int waves = journal->cache().waves; waves > 0)
        return {
            failure.code(),
            fmt::format("{}; the radiosity cache of {} wave{} is kept in '{}': go on with "
                        "--resume",
                        failure.what(), waves, waves == 1 ? "" : "s", journal->folder().string()),
            failure.rank_lost()};
    if (!resumed) journal->remove();
    return failure;
}

}  // namespace mpipov
