// A run of mpipov on a virtual clock: the Schedule that MPI drives, on ranks whose launches take
// what the cost model says. Pure and fast: some log(ranks) for each event, a few events a section.
// All times are seconds of wall time, all "cpu" those of a core of speed 1.
#pragma once

#include "schedule.h"
#include "virtual_cores.h"

#include <optional>
#include <string_view>
#include <vector>

namespace mpipov {

struct VirtualRank {
    int slots = 1;      // cores; 0: renders nothing
    int in_flight = 1;  // launches under way at once
    double speed = 1;   // CPU seconds of tracing in a second on each core
    int host = 0;       // the network is between those of different hosts
};

// The way of the pixels to rank 0. Its link takes one section at a time.
struct VirtualNetwork {
    double latency = 0;                 // of a message
    double bytes_per_second = never;    // of rank 0's link
    std::vector<double> section_bytes;  // by section; empty: none
};

// What a case calls for; none is on by itself.
struct VirtualTerms {
    // Half of it from a message's arrival until a sleeping rank looks, on each of the two ways.
    std::optional<double> answer_seconds;
    // Rank 0's loop, one message after the other: half of it for handing a section out, half for
    // taking it in. Its reciprocal is the ceiling in sections a second.
    std::optional<double> service_seconds;
    // What that loop takes from a core of rank 0 that renders too, by section.
    std::optional<double> rank0_cpu_seconds;
    std::optional<VirtualNetwork> network;
    std::optional<double> before;  // the first section: start of MPI, probe
    std::optional<double> after;   // the last one: encoding
    bool copies = false;           // idle ranks copy the section that would end last
};

struct VirtualRun {
    Policy policy = Policy::dynamic;
    std::vector<double> section_cpu;  // tracing
    std::vector<double> expected;     // what Policy::cost is told; empty: section_cpu itself
    LaunchPhases launch;              // of every launch, besides tracing
    int threads = 1;                  // of a launch, for the parallel part and tracing
    std::vector<VirtualRank> ranks;
    VirtualTerms terms;
};

struct VirtualSection {
    int rank = -1;
    double start = 0;  // of the launch that counted
    double end = 0;    // when rank 0 has its pixels
};

struct VirtualRankUse {
    int launches = 0;
    double busy_seconds = 0;  // with a launch under way, as rank 0 sees it
    double core_seconds = 0;  // of its cores, used by launches
};

struct VirtualOutcome {
    double wall_seconds = 0;
    int launches = 0, copies = 0;
    std::vector<VirtualSection> sections;
    std::vector<VirtualRankUse> ranks;
    double rank0_service_seconds = 0;  // in which rank 0's loop was at work
    double link_seconds = 0;           // in which rank 0's link was
    std::vector<std::string_view> terms_on;
};

// Their names, as they are told.
std::vector<std::string_view> terms_on(const VirtualTerms& terms);

// Throws std::invalid_argument where something is negative, no number, more than 1e15 seconds or of
// the wrong length.
void check(const VirtualRun& run);

// Throws std::invalid_argument as check() does, where no rank can render, and where the end
// is beyond a double.
VirtualOutcome run_virtually(const VirtualRun& run);

}  // namespace mpipov
