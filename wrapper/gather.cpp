#include "gather.h"

#include "event_loop.h"
#include "failure.h"
#include "radiosity_cache.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

namespace mpipov {
namespace {

Rect region_of(const GatherWave& wave) {
    return {0, 0, wave.image.width, wave.image.height};
}

CoordinatorSetup setup_of(const GatherSetup& setup, const GatherWave& wave,
                          const std::vector<RankRecord>& ranks, const std::string& cache) {
    CoordinatorSetup job = setup.job;
    const int sections = static_cast<int>(wave.sections.size());
    job.partition = {{region_of(wave), Shape::tiles, Seams::plain, sections, 0, 1}, wave.sections};
    job.image = wave.image;
    job.costs.clear();
    job.cache = cache;
    job.gathers = true;
    // A copy's last words would come in the next wave.
    job.copies_every_seconds = std::numeric_limits<double>::infinity();
    job.timeout_seconds = setup.timeout_seconds;
    for (std::size_t rank = 0; rank < ranks.size(); ++rank)
        job.ranks[rank].busy_seconds = ranks[rank].busy_seconds;
    return job;
}

}  // namespace

std::string gather_radiosity(const GatherSetup& setup, const GatherContext& context,
                             RunRecord& record, std::vector<RankRecord>& ranks) {
    RadiosityCache cache;
    Journal::Cache kept;
    if (context.journal != nullptr) kept = context.journal->cache();
    cache.add(kept.waves > 0 ? kept.text : setup.first);
    Canvas nothing({1, 1, 1, Depth::uint8});
    for (std::size_t i = static_cast<std::size_t>(kept.waves); i < setup.waves.size(); ++i) {
        const GatherWave& wave = setup.waves[i];
        Coordinator coordinator(setup_of(setup, wave, ranks, cache.text()), context.transport,
                                nothing, nullptr, context.clock);
        try {
            coordinator.start();
            run_event_loop({context.transport, context.worker, &coordinator,
                            [&] { context.progress(static_cast<int>(i), coordinator.fraction()); },
                            context.lost_after_seconds});
        } catch (const Failure& failure) {
            if (failure.code() == Exit::interrupted) throw;
            throw Failure(failure.code(),
                          fmt::format("radiosity samples, wave {} of {} ({} x {} pixels): {}",
                                      i + 1, setup.waves.size(), wave.image.width,
                                      wave.image.height, failure.what()));
        }
        // In the order of the sections, whichever ended first.
        for (const std::string& samples : coordinator.samples()) cache.add(samples);
        // Totals and warnings add up; the rest of it is the image's in the end.
        coordinator.fill(record);
        record.waves.push_back(
            {wave.image.width, wave.image.height, cache.samples(), std::move(record.sections)});
        for (std::size_t rank = 0; rank < ranks.size(); ++rank)
            ranks[rank].busy_seconds = record.ranks[rank].busy_seconds;
        if (context.journal != nullptr)
            context.journal->keep_cache(static_cast<int>(i) + 1, cache.text());
    }
    return cache.text();
}

}  // namespace mpipov
