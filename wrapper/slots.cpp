#include "slots.h"

#include <algorithm>

namespace mpipov {

int fair_slots(const std::vector<std::vector<int>>& cpus, int local_rank) {
    const std::vector<int>& mine = cpus.at(static_cast<std::size_t>(local_rank));
    int others = 0, before = 0;
    for (int rank = 0; rank < static_cast<int>(cpus.size()); ++rank) {
        if (rank == local_rank || cpus[static_cast<std::size_t>(rank)] != mine) continue;
        ++others;
        if (rank < local_rank) ++before;
    }
    const int sharers = others + 1;
    const int all = static_cast<int>(mine.size());
    return std::max(1, all / sharers + (before < all % sharers ? 1 : 0));
}

}  // namespace mpipov
