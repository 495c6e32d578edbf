// Who renders which section next. Pure bookkeeping: no MPI, no clock, no I/O; the coordinator, the
// tests and the simulator all drive this one class.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

namespace mpipov {

enum class Policy {
    static_,  // MPIPOV1: every section belongs to a worker from the start
    dynamic,  // MPIPOV2: the next section goes to whoever is free
    cost,     // the same, the longest first
};
std::string_view to_string(Policy policy);

// Of a section that is under way on another worker, seconds.
struct Outlook {
    double left = 0;  // until it ends there
    double anew = 0;  // what it takes the asking worker from its start
};

class Schedule {
  public:
    // `lanes[w]`: how many sections worker w renders at once; 0 for one that renders nothing.
    // `costs[i]`: what sections[i] is expected to take, in any unit; only Policy::cost looks at
    // them, and without them it is Policy::dynamic. Any number will do: an infinite cost comes
    // first, one that is less than nothing or no number counts as 0.
    // Throws std::invalid_argument where no worker renders or `costs` has another length.
    Schedule(Policy policy, const std::vector<int>& sections, const std::vector<int>& lanes,
             const std::vector<double>& costs = {});

    // The section that `worker` is to start now, if there is one for it; it is then under way.
    std::optional<int> next(int worker);

    // When next() has nothing left: a second copy of the section that would end last, if the worker
    // would have it earlier from its start. There are never more than two of a section, and none
    // with Policy::static_, which is to be MPIPOV1. The copy is then under way too. Of an outlook
    // that is no number nothing is copied.
    std::optional<int> next_copy(int worker, const std::function<Outlook(int section)>& outlook);

    // Whether it was handed out or not: it never is again.
    void finished(int section);

    // Gives the section back, unless a copy of it is still under way. It goes to another worker
    // next where there is one that has not failed it yet. The section must be under way there.
    void failed(int section, int worker);

    // A copy of the section was ended because the other one counts.
    void stopped(int section, int worker);

    // One more section (a seam that is rendered again); any worker may take it.
    void add(int section);

    // A better estimate of what a section takes that nobody has been given yet.
    void expect(int section, double cost);

    int attempts(int section) const;  // how often it was handed out, copies too
    int failures(int section) const;
    bool all_finished() const { return unfinished_ == 0; }
    int unfinished() const { return unfinished_; }

  private:
    struct Entry {
        int attempts = 0;
        bool done = false;
        double cost = 0;
        std::vector<int> failed_on, under_way_on;
    };

    bool may_take(int section, int worker) const;
    int hand_out(int section, int worker);
    void take_back(int section, int worker);
    void sort_by_cost();

    Policy policy_;
    std::vector<int> lanes_;
    std::deque<int> shared_;              // whoever is free takes the front
    std::vector<std::deque<int>> owned_;  // static: each worker's own
    std::map<int, Entry> entries_;
    std::set<int> under_way_;
    int unfinished_ = 0;
    bool sorted_ = true;
};

}  // namespace mpipov
