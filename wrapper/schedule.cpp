#include "schedule.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace mpipov {
namespace {

bool contains(const std::vector<int>& workers, int worker) {
    return std::find(workers.begin(), workers.end(), worker) != workers.end();
}

// Comparing with what is no number is no order.
double sane_cost(double cost) {
    return cost > 0 ? cost : 0;
}

}  // namespace

std::string_view to_string(Policy policy) {
    switch (policy) {
        case Policy::static_:
            return "static";
        case Policy::dynamic:
            return "dynamic";
        case Policy::cost:
            return "cost";
    }
    return "";
}

Schedule::Schedule(Policy policy, const std::vector<int>& sections, const std::vector<int>& lanes,
                   const std::vector<double>& costs)
    : policy_(policy), lanes_(lanes), owned_(lanes.size()) {
    if (std::none_of(lanes.begin(), lanes.end(), [](int n) { return n > 0; }))
        throw std::invalid_argument("no rank is left to render");
    if (!costs.empty() && costs.size() != sections.size())
        throw std::invalid_argument("each section has one cost");
    for (std::size_t i = 0; i < sections.size(); ++i)
        entries_[sections[i]].cost = costs.empty() ? 0 : sane_cost(costs[i]);
    unfinished_ = static_cast<int>(entries_.size());
    if (policy != Policy::static_) {
        shared_.assign(sections.begin(), sections.end());
        sort_by_cost();
        return;
    }
    // Neighbouring sections to the same worker, each as many as it has lanes.
    const long long all_lanes = std::max(1LL, std::accumulate(lanes.begin(), lanes.end(), 0LL));
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
    if (!contains(failed_on, worker)) return true;
    // It failed here: wait for somebody else, unless it has failed everywhere.
    for (std::size_t other = 0; other < lanes_.size(); ++other)
        if (lanes_[other] > 0 && !contains(failed_on, static_cast<int>(other))) return false;
    return true;
}

std::optional<int> Schedule::next(int worker) {
    if (lanes_.at(static_cast<std::size_t>(worker)) == 0) return {};
    if (!sorted_) sort_by_cost();
    for (std::deque<int>* queue : {&owned_[static_cast<std::size_t>(worker)], &shared_}) {
        // An earlier run may have finished what nobody was given yet.
        while (!queue->empty() && entries_.at(queue->front()).done) queue->pop_front();
        const auto found = std::find_if(queue->begin(), queue->end(),
                                        [&](int section) { return may_take(section, worker); });
        if (found == queue->end()) continue;
        const int section = *found;
        queue->erase(found);
        return hand_out(section, worker);
    }
    return {};
}

std::optional<int> Schedule::next_copy(int worker,
                                       const std::function<Outlook(int section)>& outlook) {
    if (policy_ == Policy::static_ || lanes_.at(static_cast<std::size_t>(worker)) == 0) return {};
    std::optional<int> last;
    double longest = 0;
    for (const int section : under_way_) {
        const Entry& entry = entries_.at(section);
        if (entry.under_way_on.size() != 1 || entry.under_way_on[0] == worker ||
            contains(entry.failed_on, worker))
            continue;
        const Outlook seconds = outlook(section);
        if (!(seconds.anew < seconds.left && seconds.left > longest)) continue;
        last = section;
        longest = seconds.left;
    }
    if (!last) return {};
    return hand_out(*last, worker);
}

int Schedule::hand_out(int section, int worker) {
    Entry& entry = entries_.at(section);
    ++entry.attempts;
    entry.under_way_on.push_back(worker);
    under_way_.insert(section);
    return section;
}

void Schedule::sort_by_cost() {
    sorted_ = true;
    if (policy_ != Policy::cost) return;
    std::stable_sort(shared_.begin(), shared_.end(),
                     [this](int a, int b) { return entries_.at(a).cost > entries_.at(b).cost; });
}

void Schedule::expect(int section, double cost) {
    entries_.at(section).cost = sane_cost(cost);
    sorted_ = false;
}

void Schedule::finished(int section) {
    Entry& entry = entries_.at(section);
    if (entry.done) return;
    entry.done = true;
    under_way_.erase(section);
    --unfinished_;
}

void Schedule::failed(int section, int worker) {
    entries_.at(section).failed_on.push_back(worker);
    take_back(section, worker);
    if (under_way_.count(section) == 0) shared_.push_front(section);
}

void Schedule::stopped(int section, int worker) {
    take_back(section, worker);
}

void Schedule::take_back(int section, int worker) {
    std::vector<int>& on = entries_.at(section).under_way_on;
    on.erase(std::find(on.begin(), on.end(), worker));
    if (on.empty()) under_way_.erase(section);
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

int Schedule::failures(int section) const {
    return static_cast<int>(entries_.at(section).failed_on.size());
}

}  // namespace mpipov
