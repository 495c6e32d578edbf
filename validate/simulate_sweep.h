// A case on several numbers of ranks: how long, how well, and what stands in the way. Pure.
#pragma once

#include "simulate_case.h"

#include <string>
#include <vector>

namespace mpipov {

struct WithoutTerm {
    std::string term;
    double wall_seconds = 0, efficiency = 0;  // with the grid that is best then
};

struct SimulateRow {
    int ranks = 1, cores = 1;
    double power = 1;  // the cores' speeds added up, a dedicated coordinator's too
    int sections = 1, in_flight = 1, launches = 0, copies = 0;
    double wall_seconds = 0, speedup = 0;
    double efficiency = 0;         // speed-up by power
    double handled_by_second = 0;  // sections that rank 0 handles, of wall time between the ends
    std::vector<WithoutTerm> without;  // the terms that are on, what helps most first
    // The same terms taken away one after the other, each with all before it.
    std::vector<WithoutTerm> one_by_one;
    std::string bound_by;  // the first of them, or "cores" where none is worth 1 %
};

// The number of sections (of launches in flight) that ends first is looked for among multiples of
// the lanes, unless the case fixes it. Throws std::invalid_argument where a number of sections is
// asked for that no grid has, or no rank renders.
SimulateRow simulate(const SimulateCase& what, int ranks);

// Of the best grid alone.
double shortest(const SimulateCase& what, int ranks);

// What the first term in the way means for the efficiency, as a law with this case's numbers, and
// what would lift it.
std::string law_of(const SimulateCase& what, const SimulateRow& row);

}  // namespace mpipov
