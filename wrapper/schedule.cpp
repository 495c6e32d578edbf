#include "schedule.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace mpipov {

std::string_view to_string(Policy policy) {
    return policy == Policy::static_ ? "static" : "dynamic";
}

Schedule::Schedule(Policy policy, const std::vector<int>& sections, const std::vector<int>& lanes)
    : lanes_(lanes), owned_(lanes.size()) {
    if (std::none_of(lanes.begin(), lanes.end(), [](int n) { return n > 0; }))
        throw std::invalid_argument("no rank is left to render");
    for (const int section : sections) entries_[section] = {};
    unfinished_ = static_cast<int>(entries_.size());
    if (policy == Policy::dynamic) {
        shared_.assign(sections.begin(), sections.end());
        return;
    }
    // Neighbouring sections to the same worker, each as many as it has lanes.
    const long long all_lanes = std::accumulate(lanes.begin(), lanes.end(), 0LL);
    const auto count = static_cast<long long>(sections.size());
    long long lanes_before = 0;
    for (std::size_t worker = 0; worker < lanes.size(); ++worker) {
        const long long from = count * lanes_before / all_lanes;
        lanes_before += lanes[worker];
        const long long to = count * lanes_before / all_lanes;
        owned_[worker].assign(sections.begin() + from, sections.begin() + to);
    }
}

bool Schedule::may_take(int section, int worker) const {
    if (entries_.at(section).done) return false;
    const std::vector<int>& failed_on = entries_.at(section).failed_on;
    if (std::find(failed_on.begin(), failed_on.end(), worker) == failed_on.end()) return true;
    // It failed here: wait for somebody else, unless it has failed everywhere.
    for (std::size_t other = 0; other < lanes_.size(); ++other)
        if (lanes_[other] > 0 && std::find(failed_on.begin(), failed_on.end(),
                                           static_cast<int>(other)) == failed_on.end())
            return false;
    return true;
}

std::optional<int> Schedule::next(int worker) {
    if (lanes_.at(static_cast<std::size_t>(worker)) == 0) return {};
    for (std::deque<int>* queue : {&owned_[static_cast<std::size_t>(worker)], &shared_}) {
        // An earlier run may have finished what nobody was given yet.
        while (!queue->empty() && entries_.at(queue->front()).done) queue->pop_front();
        const auto found = std::find_if(queue->begin(), queue->end(),
                                        [&](int section) { return may_take(section, worker); });
        if (found == queue->end()) continue;
        const int section = *found;
        queue->erase(found);
        ++entries_[section].attempts;
        return section;
    }
    return {};
}

void Schedule::finished(int section) {
    Entry& entry = entries_.at(section);
    if (entry.done) return;
    entry.done = true;
    --unfinished_;
}

void Schedule::failed(int section, int worker) {
    entries_.at(section).failed_on.push_back(worker);
    shared_.push_front(section);
}

void Schedule::add(int section) {
    if (!entries_.emplace(section, Entry{}).second)
        throw std::invalid_argument("a section is added only once");
    ++unfinished_;
    shared_.push_back(section);
}

int Schedule::attempts(int section) const {
    return entries_.at(section).attempts;
}

}  // namespace mpipov
