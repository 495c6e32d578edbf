// MPIPOV1 and MPIPOV2 of 1999 (Fava, Fava, Bertozzi: "MPIPOV: a Parallel Implementation of POV-Ray
// Based on MPI", LNCS 1697, pages 199-206), on a cluster of their time. Both render line by line,
// and no line begins before the last one is whole. Pure.
//
// In each line
// - MPIPOV1 gives rank i of n the i-th of n equal vertical strips; rank 0 renders the first one.
// The
//   others' pixels come over the network to rank 0, whose link takes them one after the other.
// - MPIPOV2 has a coordinator (rank 0) that renders nothing, and G equal strips that go to whoever
// of
//   the other n - 1 is free: a message to the rank, one with the pixels back.
// A message takes `latency` from program to program, whoever else sends meanwhile.
#pragma once

#include "cost_map.h"

#include <optional>
#include <vector>

namespace mpipov {

struct PaperMachine {
    double latency = 0;                // seconds
    double bytes_per_second = 12.5e6;  // Fast Ethernet
    double bytes_per_pixel = 3;
};

// Wall seconds, from 1 rank. One rank is the serial render: nothing is sent.
double mpipov1_seconds(const CostMap& costs, const PaperMachine& machine, int ranks);
// From 2 ranks. `strips` >= 1; no more than the image is wide are made.
double mpipov2_seconds(const CostMap& costs, const PaperMachine& machine, int ranks, int strips);

// The paper's n + 1 <= G <= W, n being the ranks that render.
inline int fewest_strips(int ranks) {
    return ranks;
}

// What is known of the paper's results: speed-up against serial.
struct PaperCell {
    int version = 1, ranks = 1;
    double speedup = 0;
    bool fitted = false;  // the model's latency comes from it
};
std::vector<PaperCell> known_paper_cells();

// The latency with which MPIPOV2 on so many ranks has this speed-up, and none where no latency
// does: even without any it is slower.
std::optional<double> fit_latency(const CostMap& costs, PaperMachine machine, int ranks, int strips,
                                  double speedup);

}  // namespace mpipov
