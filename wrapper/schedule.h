// Who renders which section next. Pure bookkeeping: no MPI, no clock, no I/O; the coordinator, the
// tests and the simulator all drive this one class.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

namespace mpipov {

enum class Policy {
    static_,  // MPIPOV1: every section belongs to a worker from the start
    dynamic,  // MPIPOV2: the next section goes to whoever is free
};
std::string_view to_string(Policy policy);

class Schedule {
  public:
    // `lanes[w]`: how many sections worker w renders at once; 0 for one that renders nothing.
    // Throws std::invalid_argument where no worker renders.
    Schedule(Policy policy, const std::vector<int>& sections, const std::vector<int>& lanes);

    // The section that `worker` is to start now, if there is one for it; it is then under way.
    std::optional<int> next(int worker);

    // Whether it was handed out or not: it never is again.
    void finished(int section);

    // Gives the section back. It goes to another worker next where there is one that has not
    // failed it yet. The section must be under way.
    void failed(int section, int worker);

    // One more section (a seam that is rendered again); any worker may take it.
    void add(int section);

    int attempts(int section) const;
    bool all_finished() const { return unfinished_ == 0; }
    int unfinished() const { return unfinished_; }

  private:
    struct Entry {
        int attempts = 0;
        bool done = false;
        std::vector<int> failed_on;
    };

    bool may_take(int section, int worker) const;

    std::vector<int> lanes_;
    std::deque<int> shared_;              // whoever is free takes the front
    std::vector<std::deque<int>> owned_;  // static: each worker's own
    std::map<int, Entry> entries_;
    int unfinished_ = 0;
};

}  // namespace mpipov
