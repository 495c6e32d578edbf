// How many cores a rank may use.
#pragma once

#include <vector>

namespace mpipov {

// `cpus[r]`: the CPUs that local rank r's affinity mask allows. Ranks with the same mask share it
// evenly, the first ones take what is left over; every rank has at least one.
int fair_slots(const std::vector<std::vector<int>>& cpus, int local_rank);

}  // namespace mpipov
