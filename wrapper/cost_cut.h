// Cutting a region up by what its parts cost: sections that shrink toward the end of the run.
//
// Every section is halved where its cost is, on the grid, until none costs more than a third of a
// lane's share; then of the last quarter of the work the sections are halved down to a twelfth of
// it. Given out the longest first (LPT: Graham 1969), the run ends within about the last and
// smallest sections of each other, as with factoring (Hummel, Schonberg, Flynn 1992). Nothing is
// halved whose halves would cost less than `least`: a launch costs too.
#pragma once

#include "cost_map.h"
#include "section.h"

namespace mpipov {

struct CutByCost {
    int lanes = 1;     // launches that run side by side
    double least = 0;  // CPU seconds of tracing that a section is to have at least
};

// `grid.shape` and `grid.sections` are not looked at; the result's shape is tiles.
Partition cut_by_cost(const GridRequest& grid, const CostMap& costs, const CutByCost& wanted);

}  // namespace mpipov
