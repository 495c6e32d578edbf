// How many cores a rank may use.
#pragma once

#include <vector>

namespace mpipov {

// `cpus[r]`: the CPUs that local rank r's affinity mask allows. Ranks with the same mask share it
// evenly, the first ones take what is left over; every rank has at least one.
int fair_slots(const std::vector<std::vector<int>>& cpus, int local_rank);

// What local rank r could use where the other ranks of its mask used nothing: the first of them the
// slots of all, the others none.
int pooled_slots(const std::vector<std::vector<int>>& cpus, int local_rank);

// Which of them rank `local_rank` keeps to when it was told to use `slots` (from 1): so many of its
// mask, and as far as there are enough not those of another rank with the same mask and `slots`.
std::vector<int> slot_cpus(const std::vector<std::vector<int>>& cpus, int local_rank, int slots);

}  // namespace mpipov
