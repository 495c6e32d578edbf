// The coordinator's care for the end of a run: idle ranks copy the section that would end last.
#include "coordinator.h"
#include "launch_costs.h"
#include "message_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace mpipov {
namespace {

// How much longer than expected a copy may take and still pay.
constexpr double copy_margin = 1.25;
// Below this POV-Ray's progress says little.
constexpr double least_fraction = 0.05;

}  // namespace

double Coordinator::cost_of(int section) const {
    const auto id = static_cast<std::size_t>(section);
    if (id < setup_.costs.size()) return setup_.costs[id];
    return static_cast<double>(sections_[id].record.section.keep.area());
}

void Coordinator::learn(const SectionRecord& record) {
    Pace& pace = pace_[static_cast<std::size_t>(record.rank)];
    pace.seconds += record.wall_seconds;
    pace.cost += cost_of(record.section.id);
}

Coordinator::Pace Coordinator::pace_of_all() const {
    Pace all;
    for (const Pace& pace : pace_) {
        all.seconds += pace.seconds;
        all.cost += pace.cost;
    }
    return all;
}

// Parts of a picture that touch are alike: what a neighbour took against what was expected of it,
// and of all.
void Coordinator::correct_neighbours(int section) {
    if (neighbours_.empty() || section >= static_cast<int>(neighbours_.size())) return;
    const Pace all = pace_of_all();
    if (all.seconds <= 0 || all.cost <= 0) return;
    for (const int neighbour : neighbours_[static_cast<std::size_t>(section)]) {
        if (schedule_.attempts(neighbour) > 0) continue;
        double seconds = 0, cost = 0;
        for (const int known : neighbours_[static_cast<std::size_t>(neighbour)]) {
            const SectionRecord& record = sections_[static_cast<std::size_t>(known)].record;
            if (record.end <= 0 || record.resumed) continue;
            seconds += record.wall_seconds;
            cost += cost_of(known);
        }
        if (cost > 0)
            schedule_.expect(neighbour,
                             cost_of(neighbour) * (seconds / cost) / (all.seconds / all.cost));
    }
}

// From what the worker has finished, or where it has nothing yet from what all have.
std::optional<double> Coordinator::expected_seconds(int section, int worker) const {
    Pace pace = pace_[static_cast<std::size_t>(worker)];
    if (pace.cost <= 0) pace = pace_of_all();
    if (pace.cost <= 0) return {};
    return pace.seconds / pace.cost * cost_of(section);
}

Outlook Coordinator::outlook(int section, int worker) const {
    const Progress& progress = sections_[static_cast<std::size_t>(section)];
    // A seam that is rendered again is small, and what it is compared with must come from one
    // launch.
    if (progress.seam >= 0 || progress.next_row > progress.record.section.render.y0) return {};
    const std::optional<double> there = expected_seconds(section, progress.runs[0].rank);
    const std::optional<double> here = expected_seconds(section, worker);
    if (!there || !here) return {};
    const double elapsed = clock_() - progress.runs[0].start;
    const double fraction = progress.runs[0].fraction;
    // Without a word of it for longer than it should take in all, it may take as long again.
    const double left = fraction >= least_fraction ? elapsed * (1 - fraction) / fraction
                                                   : std::max(*there - elapsed, elapsed);
    return {left, startup_wall_seconds + copy_margin * *here};
}

void Coordinator::tick() {
    feed_caches();
    const double now = clock_();
    if (now - looked_for_copies_ < setup_.copies_every_seconds) return;
    looked_for_copies_ = now;
    for (int worker = 0; worker < static_cast<int>(setup_.ranks.size()); ++worker) {
        // A core that still has another launch to compute has nothing to give.
        const auto rank = static_cast<std::size_t>(worker);
        if (under_way_[rank] > 0 || fed_[rank] < setup_.cache.size()) continue;
        const auto copy =
            schedule_.next_copy(worker, [&](int section) { return outlook(section, worker); });
        if (copy) begin(*copy, worker);
    }
}

void Coordinator::keep_only(Progress& progress, const Run& winner) {
    const Run kept = winner;
    for (const Run& run : progress.runs) {
        if (run.attempt == kept.attempt) continue;
        const int id = progress.record.section.id;
        losers_.insert({id, run.attempt, run.rank});
        schedule_.stopped(id, run.rank);
        transport_.send(
            {MessageKind::cancel, run.rank, {{"section", id}, {"attempt", run.attempt}}, {}});
    }
    if (progress.runs.size() > 1) progress.runs.assign(1, kept);
}

void Coordinator::take_end_of_loser(const Message& message) {
    const MessageFields fields(message.head);
    const int id = fields.section();
    const int attempt = fields.attempt();
    const double cpu_seconds = fields.seconds("cpu_seconds");
    if (losers_.erase({id, attempt, message.peer}) == 0)
        throw std::runtime_error(
            fmt::format("rank {} ended section {} that it was not told to", message.peer, id));
    end_launch(message.peer, cpu_seconds);
    assign_to_all();
}

}  // namespace mpipov
