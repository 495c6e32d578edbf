#include "virtual_cores.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace mpipov {

int VirtualCores::computing_threads() const {
    return std::accumulate(launches_.begin(), launches_.end(), 0,
                           [](int sum, const Launch& launch) { return sum + launch.threads; });
}

// CPU seconds of speed 1 in a wall second, where so many threads compute.
double VirtualCores::per_thread(int threads) const {
    const double cores = coordinator_cpu_ > 0 ? std::max(0, cores_ - 1) : cores_;
    return threads > 0 ? speed_ * std::min(1.0, cores / threads) : 0;
}

void VirtualCores::go_to(double now) {
    const double seconds = now - now_;
    const int threads = computing_threads();
    const double rate = per_thread(threads);
    served_ += rate * seconds;
    core_seconds_ += rate / speed_ * threads * seconds;
    coordinator_cpu_ = std::max(0.0, coordinator_cpu_ - speed_ * seconds);
    now_ = now;
}

// Begins the next part that takes time; false where there is none.
bool VirtualCores::next_part(Launch& launch, double now) const {
    const auto take = [](double& seconds) { return std::exchange(seconds, 0.0); };
    if (const double idle = take(launch.rest.idle_before); idle > 0) {
        launch.threads = 0;
        launch.until = now + idle;
    } else if (const double serial = take(launch.rest.serial_cpu); serial > 0) {
        launch.threads = 1;
        launch.until = served_ + serial;
    } else if (const double parallel = take(launch.rest.parallel_cpu); parallel > 0) {
        launch.threads = threads_;
        launch.until = served_ + parallel / threads_;
    } else if (const double after = take(launch.rest.idle_after); after > 0) {
        launch.threads = 0;
        launch.until = now + after;
    } else {
        return false;
    }
    return true;
}

void VirtualCores::look_ahead(double now) {
    const double rate = per_thread(computing_threads());
    next_time_ = coordinator_cpu_ > 0 ? now + coordinator_cpu_ / speed_ : never;
    next_launch_ = -1;
    for (std::size_t i = 0; i < launches_.size(); ++i) {
        const Launch& launch = launches_[i];
        double time = launch.until;
        if (launch.threads > 0)
            time = rate > 0 ? now + std::max(0.0, launch.until - served_) / rate : never;
        if (time >= next_time_) continue;
        next_time_ = time;
        next_launch_ = static_cast<int>(i);
    }
}

void VirtualCores::start(double now, int id, const LaunchPhases& phases) {
    go_to(now);
    Launch launch{id, phases, 0, now};
    // A launch that takes no time at all ends in a step of its own, as any other.
    next_part(launch, now);
    launches_.push_back(launch);
    look_ahead(now);
}

void VirtualCores::cancel(double now, int id) {
    go_to(now);
    std::erase_if(launches_, [id](const Launch& launch) { return launch.id == id; });
    look_ahead(now);
}

void VirtualCores::first_do(double now, double cpu_seconds) {
    go_to(now);
    coordinator_cpu_ += cpu_seconds;
    look_ahead(now);
}

int VirtualCores::step() {
    const double now = next_time_;
    go_to(now);
    int ended = -1;
    if (next_launch_ < 0) {
        coordinator_cpu_ = 0;  // whatever rounding left
    } else {
        const auto it = launches_.begin() + next_launch_;
        if (it->threads > 0) served_ = std::max(served_, it->until);
        if (!next_part(*it, now)) {
            ended = it->id;
            launches_.erase(it);
        }
    }
    look_ahead(now);
    return ended;
}

double VirtualCores::seconds_left(double now, int id) const {
    const auto it = std::find_if(launches_.begin(), launches_.end(),
                                 [id](const Launch& launch) { return launch.id == id; });
    if (it == launches_.end()) return 0;
    const int threads = computing_threads();
    const LaunchPhases& rest = it->rest;
    double cpu = rest.serial_cpu + rest.parallel_cpu / threads_;
    double wall = rest.idle_before + rest.idle_after;
    if (it->threads > 0)
        cpu += it->until - served_ - per_thread(threads) * (now - now_);
    else
        wall += it->until - now;
    const double rate = per_thread(std::max(threads, 1));
    if (cpu > 0) wall += rate > 0 ? cpu / rate : never;
    return std::max(0.0, wall);
}

double VirtualCores::seconds_anew(const LaunchPhases& phases) const {
    const int beside = computing_threads();
    const auto seconds = [&](double cpu, int threads) {
        if (cpu <= 0) return 0.0;
        const double rate = per_thread(beside + threads) * threads;
        return rate > 0 ? cpu / rate : never;
    };
    return phases.idle_before + seconds(phases.serial_cpu, 1) +
           seconds(phases.parallel_cpu, threads_) + phases.idle_after;
}

}  // namespace mpipov
