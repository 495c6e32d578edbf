// The cores of one rank on a virtual clock, shared by the launches of POV-Ray that compute there.
// Processor sharing: every computing thread gets the same, a whole core at most, as under Linux's
// scheduler. Pure; times are seconds of the virtual clock and never go back.
#pragma once

#include <limits>
#include <vector>

namespace mpipov {

constexpr double never = std::numeric_limits<double>::infinity();

// What a launch does from its start to its end, in this order. CPU seconds are those of a core of
// speed 1; wall seconds pass while its core is free for others.
struct LaunchPhases {
    double idle_before = 0;   // wall
    double serial_cpu = 0;    // by one thread
    double parallel_cpu = 0;  // shared by all threads of the launch
    double idle_after = 0;    // wall
};

class VirtualCores {
  public:
    // `threads`: of every launch, in its parallel part. Without cores nothing may be started.
    VirtualCores(int cores, double speed, int threads)
        : cores_(cores), speed_(speed), threads_(threads) {}

    void start(double now, int launch, const LaunchPhases& phases);
    // The launch is gone at once; nothing happens where it is not here.
    void cancel(double now, int launch);
    // Work that goes before all launches, on one core at most: the coordinator's own.
    void first_do(double now, double cpu_seconds);

    // When something ends next: never, where nothing is under way.
    double next_time() const { return next_time_; }
    // What ends at next_time(): a launch as a whole, or -1 where it was only a part.
    int step();

    int launches() const { return static_cast<int>(launches_.size()); }
    // Of a launch that is here: wall seconds until its end, as long as the cores are shared as now.
    double seconds_left(double now, int launch) const;
    // Wall seconds of one more launch, shared as when it would compute beside those of now.
    double seconds_anew(const LaunchPhases& phases) const;

    double core_seconds() const { return core_seconds_; }  // used by launches so far

  private:
    struct Launch {
        int id = 0;
        LaunchPhases rest;  // after the part that is under way
        int threads = 0;    // 0: idle
        double until = 0;   // idle: a time; computing: a reading of served_
    };

    void go_to(double now);
    bool next_part(Launch& launch, double now) const;
    void look_ahead(double now);
    double per_thread(int threads) const;
    int computing_threads() const;

    int cores_;
    double speed_;
    int threads_;
    double now_ = 0;
    // CPU seconds (of speed 1) that each thread that computed all along has got since the start.
    double served_ = 0;
    double coordinator_cpu_ = 0;
    double core_seconds_ = 0;
    std::vector<Launch> launches_;
    double next_time_ = never;
    int next_launch_ = -1;  // index; -1: the coordinator's work
};

}  // namespace mpipov
