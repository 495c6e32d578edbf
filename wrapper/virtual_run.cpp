#include "virtual_run.h"

#include <algorithm>
#include <numeric>
#include <queue>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace mpipov {
namespace {

std::size_t at(int index) {
    return static_cast<std::size_t>(index);
}

struct Event {
    enum class Kind {
        cores,    // index: rank; version: of its cores' plan
        start,    // index: launch; its assignment has reached the rank
        arrived,  // index: launch; its pixels have reached rank 0
        handled,  // index: launch; rank 0 has placed them
        cancel,   // index: launch
    };
    double time = 0;
    long long number = 0;  // in the order of making: among equal times the first comes first
    Kind kind = Kind::cores;
    int index = 0;
    long long version = 0;

    bool operator>(const Event& other) const {
        return std::tie(time, number) > std::tie(other.time, other.number);
    }
};

struct Launch {
    int section = 0, rank = 0;
    double start = 0;
    bool started = false, cancelled = false;
};

struct Rank {
    VirtualCores cores;
    long long version = 0;
    int under_way = 0;  // as rank 0 sees it
    double busy_since = 0;
};

// A server that takes one job after the other.
struct Server {
    double free_at = 0, busy = 0;
    double serve(double now, double seconds) {
        free_at = std::max(free_at, now) + seconds;
        busy += seconds;
        return free_at;
    }
};

class Simulation {
  public:
    explicit Simulation(const VirtualRun& run);
    VirtualOutcome outcome();

  private:
    void push(double time, Event::Kind kind, int index, long long version = 0);
    void plan_cores(int rank);
    void take(const Event& event);
    void step_cores(int rank);
    void handled(int launch, double now);
    void fill_lane(int rank, double now);
    bool assign(int rank, double now);
    bool copy(int rank, double now);
    void hand_out(int section, int rank, double now);
    double serve(double now);
    double way(int rank) const;
    LaunchPhases phases(int section) const;
    Outlook outlook(int section, int rank, double now) const;
    void drop_under_way(int section);

    const VirtualRun& run_;
    Schedule schedule_;
    std::vector<Rank> ranks_;
    std::vector<Launch> launches_;
    std::vector<std::vector<int>> launches_of_;  // by section
    std::vector<int> under_way_;                 // sections that are not finished, handed out once
    std::vector<int> place_;                     // in under_way_, by section; -1: not there
    std::priority_queue<Event, std::vector<Event>, std::greater<>> events_;
    long long events_made_ = 0;
    Server loop_, link_;
    VirtualOutcome result_;
};

std::vector<int> lanes_of(const std::vector<VirtualRank>& ranks) {
    std::vector<int> lanes;
    lanes.reserve(ranks.size());
    for (const VirtualRank& rank : ranks) lanes.push_back(rank.slots);
    return lanes;
}

std::vector<int> ids(std::size_t count) {
    std::vector<int> all(count);
    std::iota(all.begin(), all.end(), 0);
    return all;
}

Simulation::Simulation(const VirtualRun& run)
    : run_(run),
      schedule_(run.policy, ids(run.section_cpu.size()), lanes_of(run.ranks),
                run.expected.empty() ? run.section_cpu : run.expected),
      launches_of_(run.section_cpu.size()),
      place_(run.section_cpu.size(), -1) {
    for (const VirtualRank& rank : run.ranks)
        ranks_.push_back({VirtualCores(rank.slots, rank.speed, run.threads)});
    result_.sections.resize(run.section_cpu.size());
    result_.ranks.resize(run.ranks.size());
}

void Simulation::push(double time, Event::Kind kind, int index, long long version) {
    events_.push({time, events_made_++, kind, index, version});
}

// After every change of a rank's cores; what was planned before is void.
void Simulation::plan_cores(int rank) {
    Rank& r = ranks_[at(rank)];
    ++r.version;
    if (r.cores.next_time() < never) push(r.cores.next_time(), Event::Kind::cores, rank, r.version);
}

// Half of what a section takes of rank 0's loop.
double Simulation::serve(double now) {
    if (run_.terms.rank0_cpu_seconds && run_.ranks[0].slots > 0) {
        ranks_[0].cores.first_do(now, *run_.terms.rank0_cpu_seconds / 2);
        plan_cores(0);
    }
    return loop_.serve(now, run_.terms.service_seconds.value_or(0) / 2);
}

// From a rank to rank 0 or back, without the pixels. What rank 0 tells itself waits for nobody.
double Simulation::way(int rank) const {
    if (rank == 0) return 0;
    double seconds = run_.terms.answer_seconds.value_or(0) / 2;
    if (run_.terms.network && run_.ranks[at(rank)].host != run_.ranks[0].host)
        seconds += run_.terms.network->latency;
    return seconds;
}

LaunchPhases Simulation::phases(int section) const {
    LaunchPhases all = run_.launch;
    all.parallel_cpu += run_.section_cpu[at(section)];
    return all;
}

void Simulation::hand_out(int section, int rank, double now) {
    const int launch = static_cast<int>(launches_.size());
    launches_.push_back({section, rank});
    launches_of_[at(section)].push_back(launch);
    if (launches_of_[at(section)].size() == 1) {
        place_[at(section)] = static_cast<int>(under_way_.size());
        under_way_.push_back(section);
    } else {
        ++result_.copies;
        drop_under_way(section);
    }
    Rank& r = ranks_[at(rank)];
    if (r.under_way++ == 0) r.busy_since = now;
    ++result_.ranks[at(rank)].launches;
    push(serve(now) + way(rank), Event::Kind::start, launch);
}

void Simulation::drop_under_way(int section) {
    const int place = std::exchange(place_[at(section)], -1);
    if (place < 0) return;
    under_way_[at(place)] = under_way_.back();
    place_[at(under_way_.back())] = place;
    if (under_way_.back() == section) place_[at(section)] = -1;
    under_way_.pop_back();
}

bool Simulation::assign(int rank, double now) {
    if (ranks_[at(rank)].under_way >= run_.ranks[at(rank)].in_flight) return false;
    const std::optional<int> next = schedule_.next(rank);
    if (next) hand_out(*next, rank, now);
    return next.has_value();
}

Outlook Simulation::outlook(int section, int rank, double now) const {
    const Launch& launch = launches_[at(launches_of_[at(section)].front())];
    const VirtualCores& there = ranks_[at(launch.rank)].cores;
    return {launch.started ? there.seconds_left(now, launches_of_[at(section)].front())
                           : there.seconds_anew(phases(section)),
            ranks_[at(rank)].cores.seconds_anew(phases(section))};
}

// A free core copies what would end last. It is asked for only when a lane of its rank becomes
// free: later nothing can come that pays, because what is left elsewhere only gets less, and what
// it would take here changes only when a launch ends here. And Schedule, which looks at all
// sections, is asked only where a look at those under way has found one.
bool Simulation::copy(int rank, double now) {
    if (!run_.terms.copies || run_.policy == Policy::static_) return false;
    const VirtualRank& about = run_.ranks[at(rank)];
    if (ranks_[at(rank)].under_way >= std::min(about.slots, about.in_flight)) return false;
    const bool pays = std::ranges::any_of(under_way_, [&](int section) {
        if (launches_[at(launches_of_[at(section)].front())].rank == rank) return false;
        const Outlook seconds = outlook(section, rank, now);
        return seconds.anew < seconds.left;
    });
    if (!pays) return false;
    const std::optional<int> section =
        schedule_.next_copy(rank, [&](int one) { return outlook(one, rank, now); });
    if (section) hand_out(*section, rank, now);
    return section.has_value();
}

void Simulation::fill_lane(int rank, double now) {
    while (assign(rank, now)) {
    }
    while (copy(rank, now)) {
    }
}

void Simulation::step_cores(int rank) {
    Rank& r = ranks_[at(rank)];
    const double now = r.cores.next_time();
    const int ended = r.cores.step();
    plan_cores(rank);
    if (ended < 0) return;
    double leaves = now;
    const auto& network = run_.terms.network;
    if (network && !network->section_bytes.empty() &&
        run_.ranks[at(rank)].host != run_.ranks[0].host)
        leaves = link_.serve(now, network->section_bytes[at(launches_[at(ended)].section)] /
                                      network->bytes_per_second);
    push(leaves + way(rank), Event::Kind::arrived, ended);
}

void Simulation::handled(int index, double now) {
    const Launch launch = launches_[at(index)];
    if (launch.cancelled) return;
    schedule_.finished(launch.section);
    drop_under_way(launch.section);
    result_.sections[at(launch.section)] = {launch.rank, launch.start, now};
    std::vector<int> freed;
    for (const int one : launches_of_[at(launch.section)]) {
        const int rank = launches_[at(one)].rank;
        freed.push_back(rank);
        Rank& r = ranks_[at(rank)];
        if (--r.under_way == 0) result_.ranks[at(rank)].busy_seconds += now - r.busy_since;
        if (one == index) continue;
        launches_[at(one)].cancelled = true;
        push(now + way(rank), Event::Kind::cancel, one);
    }
    for (const int rank : freed) fill_lane(rank, now);
}

void Simulation::take(const Event& event) {
    switch (event.kind) {
        case Event::Kind::cores:
            if (event.version == ranks_[at(event.index)].version) step_cores(event.index);
            return;
        case Event::Kind::start: {
            Launch& launch = launches_[at(event.index)];
            if (launch.cancelled) return;
            launch.started = true;
            launch.start = event.time;
            ranks_[at(launch.rank)].cores.start(event.time, event.index, phases(launch.section));
            plan_cores(launch.rank);
            return;
        }
        case Event::Kind::arrived:
            if (!launches_[at(event.index)].cancelled)
                push(serve(event.time), Event::Kind::handled, event.index);
            return;
        case Event::Kind::handled:
            handled(event.index, event.time);
            return;
        case Event::Kind::cancel: {
            const int rank = launches_[at(event.index)].rank;
            ranks_[at(rank)].cores.cancel(event.time, event.index);
            plan_cores(rank);
            return;
        }
    }
}

VirtualOutcome Simulation::outcome() {
    const double begin = run_.terms.before.value_or(0);
    const int count = static_cast<int>(ranks_.size());
    // One each in turn, as the coordinator does.
    for (bool given = true; given;) {
        given = false;
        for (int rank = 0; rank < count; ++rank) given = assign(rank, begin) || given;
    }
    for (int rank = 0; rank < count; ++rank) fill_lane(rank, begin);
    double now = begin;
    while (!schedule_.all_finished() && !events_.empty()) {
        const Event event = events_.top();
        events_.pop();
        now = event.time;
        take(event);
    }
    if (!schedule_.all_finished())
        throw std::invalid_argument("the run has no end: a rank's speed is next to nothing");
    result_.wall_seconds = now + run_.terms.after.value_or(0);
    result_.launches = static_cast<int>(launches_.size());
    for (std::size_t rank = 0; rank < ranks_.size(); ++rank)
        result_.ranks[rank].core_seconds = ranks_[rank].cores.core_seconds();
    result_.rank0_service_seconds = loop_.busy;
    result_.link_seconds = link_.busy;
    result_.terms_on = terms_on(run_.terms);
    return std::move(result_);
}

}  // namespace

VirtualOutcome run_virtually(const VirtualRun& run) {
    check(run);
    return Simulation(run).outcome();
}

}  // namespace mpipov
