#include "scene_plan.h"

#include "cost_cut.h"
#include "cost_model.h"
#include "scene_effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <stdexcept>

namespace mpipov {
namespace {

constexpr int povray_block = 32;
// A render that takes longer is cut at least so that a section is about this long: what an
// interruption can lose, and how often progress moves.
constexpr double longest_section_seconds = 60;
// No section is cut by its costs that would take less.
constexpr double least_section_cpu = 0.5;
// The grid of a scene whose pixels depend on the grid comes from the image alone.
constexpr double pinned_section_pixels = 40000;
// With radiosity a section is launched twice, and reads a cache.
constexpr double pinned_radiosity_pixels = 100000;
constexpr int fewest_pinned = 4, most_pinned = 64;

int clamp_to(long long value, long long low, long long high) {
    return static_cast<int>(std::clamp(value, low, std::max(low, high)));
}

struct Choice {
    int sections = 1, threads = 1;
    double wall = 0;
    bool pooled = false;                // one rank a host renders, with all of its cores
    std::optional<Partition> cut = {};  // by what its parts cost
};

// The cheapest number of sections for launches of `threads` threads.
Choice cheapest(const CostModel& cost, int lanes, int threads, long long most) {
    Choice best;
    const auto limit = std::min<long long>(most, 64LL * lanes);
    // Clamped as doubles: what an absurd time is divided by is beyond a whole number.
    const double by_length = std::round(cost.render / threads / longest_section_seconds);
    const int fewest =
        static_cast<int>(std::clamp(by_length, 1.0, std::max(1.0, static_cast<double>(limit))));
    best = {fewest, threads, cost.wall_seconds(fewest, lanes, threads)};
    for (int n = fewest + 1; n <= limit; ++n) {
        const double wall = cost.wall_seconds(n, lanes, threads);
        if (wall < best.wall) best = {n, threads, wall};
    }
    return best;
}

Seams choose_seams(const PlanRequest& request, const Antialiasing& aa) {
    if (request.seams) return *request.seams;
    return aa.on && aa.method == 1 ? Seams::aligned : Seams::plain;
}

long long most_sections(GridRequest grid, Shape shape) {
    grid.shape = shape;
    return max_sections(grid);
}

// For each lane one launch under way, and enough more that a core has work while launches that
// start or end are idle.
int launches_per_lane(const CostModel& cost, const Choice& choice, int all_lanes) {
    if (choice.sections <= all_lanes) return 1;
    const double busy =
        std::max(0.02, cost.render / choice.sections / choice.threads + cost.per_launch);
    constexpr int most_idle = 7;  // 16 trivial launches on a core: 8 at once are fastest
    return 1 + clamp_to(std::llround(std::ceil(cost.startup_wall / busy)), 1, most_idle);
}

// What there is to render with.
struct Cores {
    std::vector<int> slots;  // by rank, 0: renders nothing
    int ranks = 0;           // that render
    int most_of_a_rank = 0;

    // Launches of so many threads that can run side by side, at least one on each rank.
    int lanes(int threads) const {
        return std::accumulate(slots.begin(), slots.end(), 0, [threads](int sum, int n) {
            return n > 0 ? sum + std::max(1, n / threads) : sum;
        });
    }
};

Cores count_cores(const std::vector<int>& slots) {
    Cores cores{slots, 0, 0};
    cores.ranks =
        static_cast<int>(std::count_if(slots.begin(), slots.end(), [](int n) { return n > 0; }));
    if (cores.ranks == 0)
        throw std::invalid_argument(
            "no rank is left to render: start more than one with --dedicated-coordinator");
    cores.most_of_a_rank = *std::max_element(cores.slots.begin(), cores.slots.end());
    return cores;
}

// One rank a host, with all of its cores.
Cores pooled_cores(const PlanRequest& request) {
    if (request.pools.empty() || request.dedicated_coordinator) return {};
    // All launches have equally many threads, so unequal pools would be overloaded or idle.
    int pool = 0;
    for (const int cores : request.pools) {
        if (cores > 0 && pool > 0 && cores != pool) return {};
        pool = std::max(pool, cores);
    }
    return count_cores(request.pools);
}

// n+1 <= G <= W, for vertical strips; where the shape is left to us, too many must not become
// tiles.
void check_bounds_of_mpipov2(const PlanRequest& request, int ranks, int width) {
    if (*request.sections < ranks + 1)
        throw std::invalid_argument(fmt::format(
            "--sections {}: {} rendering ranks with --dedicated-coordinator need at least {}",
            *request.sections, ranks, ranks + 1));
    if (request.shape.value_or(Shape::columns) == Shape::columns && *request.sections > width)
        throw std::invalid_argument(
            fmt::format("--sections {}: with --dedicated-coordinator there are at most as many as "
                        "columns of pixels, {}; or choose --shape tiles",
                        *request.sections, width));
}

// How many sections, and launches of how many threads.
Choice choose_sections(const PlanRequest& request, const GridRequest& grid, const CostModel& cost,
                       const Cores& cores, bool pinned, const ProbeResult& probe) {
    const long long most = most_sections(grid, request.shape.value_or(Shape::tiles));
    // With a halo a launch renders its section as one block, and threads share whole blocks.
    const bool one_thread = grid.seams == Seams::halo;
    const int threads = one_thread ? 1 : request.threads.value_or(1);
    if (request.sections) {
        if (request.dedicated_coordinator && request.schedule != Policy::static_)
            check_bounds_of_mpipov2(request, cores.ranks, grid.region.width());
        return {*request.sections, threads, 0};
    }
    if (pinned) {
        const double wanted =
            static_cast<double>(grid.region.area()) /
            (probe.report.radiosity ? pinned_radiosity_pixels : pinned_section_pixels);
        return {clamp_to(std::llround(wanted), std::min<long long>(fewest_pinned, most),
                         std::min<long long>(most_pinned, most)),
                threads, 0};
    }
    const int lanes = cores.lanes(threads);
    if (request.schedule == Policy::cost && request.costs && !request.shape) {
        const Partition cut = cut_by_cost(
            grid, *request.costs, {lanes, std::max(least_section_cpu, 4 * cost.per_launch)});
        const int sections = static_cast<int>(cut.sections.size());
        if (!request.dedicated_coordinator || sections > cores.ranks)
            return {sections, threads, 0, false, cut};
    }
    if (request.schedule == Policy::static_) return {clamp_to(lanes, 1, most), threads, 0};
    Choice choice = cheapest(cost, lanes, threads, most);
    // Photons of several threads are not the same ones twice (docs/povray.md).
    if (!request.threads && !one_thread && !probe.report.photons) {
        // The scene is parsed once a launch: fewer launches of more threads.
        for (const Cores& with : {cores, pooled_cores(request)}) {
            if (with.most_of_a_rank < 2) continue;
            Choice threaded = cheapest(cost, with.ranks, with.most_of_a_rank, most);
            threaded.pooled = with.slots != cores.slots;
            if (threaded.wall < choice.wall) choice = threaded;
        }
    }
    if (request.dedicated_coordinator)
        choice.sections =
            clamp_to(choice.sections, std::min<long long>(cores.ranks + 1, most), most);
    return choice;
}

// A pretrace's steps are parts of the image's width: more pixels bring hardly any more samples, and
// cost as much as they do in the image (docs/radiosity.md). From the image alone, as the grid.
int scale_to_gather_at(const ImageOptions& image) {
    constexpr int wide_enough = 400;
    return std::max(1, std::max(image.width, image.height) / wide_enough);
}

RadiositySharing choose_sharing(const PlanRequest& request, const ProbeResult& probe, int sections,
                                std::vector<std::string>& notes) {
    const bool asked = request.radiosity.value_or(Sharing::independent) != Sharing::independent;
    if (!probe.report.radiosity) {
        if (asked) notes.push_back("the scene has no radiosity: --radiosity does nothing");
        return {};
    }
    if (probe.writes_cache)
        notes.push_back(
            "the radiosity cache of the settings (+RFO) is not written: several launches would "
            "write it one over the other");
    if (probe.own_cache) {
        if (asked)
            notes.push_back(
                "the settings name a radiosity cache to read (+RFI): --radiosity does nothing");
        return {};
    }
    const Sharing by_itself = sections > 1 ? Sharing::joined : Sharing::independent;
    const Sharing how = request.radiosity.value_or(by_itself);
    if (how == Sharing::independent) return {};
    return {how, request.radiosity_passes,
            request.radiosity_scale.value_or(
                how == Sharing::joined ? scale_to_gather_at(probe.image) : 1)};
}

std::vector<WaveShare> shares_of(const std::vector<GatherWave>& waves, const Rect& region) {
    std::vector<WaveShare> shares;
    for (const GatherWave& wave : waves) {
        double pixels = 0;
        for (const Section& section : wave.sections)
            pixels += static_cast<double>(section.render.area());
        shares.push_back({static_cast<int>(wave.sections.size()),
                          std::min(1.0, pixels / static_cast<double>(region.area()))});
    }
    return shares;
}

}  // namespace

Plan make_plan(const PlanRequest& request, const ProbeResult& given) {
    const ProbeResult probe = with_sane_times(given);
    Plan plan;
    CostModel cost = make_cost_model(probe);
    cost.early_threads = request.early_threads;
    if (request.costs) cost.render = request.costs->cpu_seconds();
    const Antialiasing& aa = probe.report.antialiasing;
    PlanRecord& record = plan.record;
    record.effects = find_effects(probe);
    const bool pinned = record.effects.at("order_dependent").on;
    record.image = probe.stored;
    record.image.width = probe.image.width;
    record.image.height = probe.image.height;
    record.region = probe.image.region;

    GridRequest grid;
    grid.region = probe.image.region;
    grid.seams = choose_seams(request, aa);
    grid.block = probe.user_block > 0 ? probe.user_block : povray_block;
    grid.halo = grid.seams == Seams::halo ? request.halo : 0;

    Cores cores = count_cores(request.slots);
    const Choice choice = choose_sections(request, grid, cost, cores, pinned, probe);
    if (choice.pooled) cores = pooled_cores(request);
    plan.slots = cores.slots;
    if (pinned && choice.threads > 1)
        plan.notes.push_back(
            "the scene depends on the order of rendering: with more than one thread a launch, "
            "no two runs are alike");
    else if (probe.report.photons && choice.threads > 1)
        plan.notes.push_back(
            "the scene has photons: with more than one thread a launch, no two runs are alike");
    if (request.threads.value_or(1) > choice.threads)
        plan.notes.push_back("with halo seams a launch has one thread: --threads does nothing");

    grid.sections = choice.sections;
    grid.shape = request.shape.value_or(auto_shape(grid));
    try {
        plan.partition = choice.cut ? *choice.cut : make_partition(grid);
    } catch (const std::invalid_argument& error) {
        if (!request.sections) throw;
        throw std::invalid_argument(
            fmt::format("--sections {}: {}", *request.sections, error.what()));
    }

    grid.shape = plan.partition.request.shape;
    if (choice.cut)
        for (const Section& section : plan.partition.sections) record.cuts.push_back(section.keep);
    if (request.costs)
        for (const Section& section : plan.partition.sections)
            plan.costs.push_back(request.costs->cpu_seconds(section.render) + cost.per_launch);
    record.shape = grid.shape;
    record.seams = grid.seams;
    record.halo = grid.halo;
    record.block = grid.block;
    record.sections = choice.sections;
    record.schedule = to_string(request.schedule);
    record.threads = choice.threads;
    const int all_lanes = cores.lanes(choice.threads);
    const int per_lane = launches_per_lane(cost, choice, all_lanes);
    for (const int slots : plan.slots)
        plan.in_flight.push_back(
            request.in_flight.value_or(std::max(1, slots / choice.threads) * per_lane));
    record.in_flight = *std::max_element(plan.in_flight.begin(), plan.in_flight.end());
    record.radiosity = choose_sharing(request, probe, choice.sections, plan.notes);
    plan.waves =
        gather_waves(record.radiosity, {record.image.width, record.image.height}, plan.partition);
    plan.takes_early = request.early_threads > 0 && choice.sections == 1 && plan.waves.empty() &&
                       choice.threads == request.early_threads && grid.seams != Seams::halo;
    const Predicted gathering =
        gathering_cost(cost, shares_of(plan.waves, record.region), all_lanes, choice.threads);
    if (!plan.waves.empty()) cost = with_cache(cost);
    record.predicted = {
        gathering.wall_seconds + cost.wall_seconds(choice.sections, all_lanes, choice.threads),
        gathering.cpu_seconds + cost.cpu_seconds(choice.sections)};
    if (choice.sections < cores.ranks)
        plan.notes.push_back(fmt::format("{} of {} ranks have nothing to render: {} sections",
                                         cores.ranks - choice.sections, cores.ranks,
                                         choice.sections));
    return plan;
}

}  // namespace mpipov
