#include "slots.h"

#include <algorithm>

namespace mpipov {

namespace {

// How many ranks before this one have its mask.
int sharers_before(const std::vector<std::vector<int>>& cpus, int local_rank) {
    const auto mine = cpus.begin() + local_rank;
    return static_cast<int>(std::count(cpus.begin(), mine, *mine));
}

}  // namespace

int fair_slots(const std::vector<std::vector<int>>& cpus, int local_rank) {
    const std::vector<int>& mine = cpus.at(static_cast<std::size_t>(local_rank));
    const auto sharers = static_cast<int>(std::count(cpus.begin(), cpus.end(), mine));
    const int all = static_cast<int>(mine.size());
    const bool one_more = sharers_before(cpus, local_rank) < all % sharers;
    return std::max(1, all / sharers + (one_more ? 1 : 0));
}

int pooled_slots(const std::vector<std::vector<int>>& cpus, int local_rank) {
    const auto mine = static_cast<std::size_t>(local_rank);
    if (sharers_before(cpus, local_rank) > 0) return 0;
    return std::max(1, static_cast<int>(cpus.at(mine).size()));
}

std::vector<int> slot_cpus(const std::vector<std::vector<int>>& cpus, int local_rank, int slots) {
    const std::vector<int>& mine = cpus.at(static_cast<std::size_t>(local_rank));
    if (mine.empty()) return {};
    const std::size_t count = std::min(static_cast<std::size_t>(slots), mine.size());
    const std::size_t first = static_cast<std::size_t>(sharers_before(cpus, local_rank)) * count;
    std::vector<int> kept;
    for (std::size_t i = 0; i < count; ++i) kept.push_back(mine[(first + i) % mine.size()]);
    return kept;
}

}  // namespace mpipov
