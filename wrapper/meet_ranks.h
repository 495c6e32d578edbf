// Rank 0 at the beginning of a run: who is there, and can all of them render.
#pragma once

#include "run_setup.h"
#include "transport.h"

#include <string>

namespace mpipov {

// Waits for the word of every other rank. `rank0` and `pool0` are our own. Throws Failure, with the
// host's name: scene where it has another POV-Ray than `povray`; what it says itself where it
// cannot render; interrupted where one does not come; std::runtime_error where a rank says anything
// else.
MetRanks meet_ranks(const RankRecord& rank0, int pool0, Transport& transport,
                    const std::string& povray);

}  // namespace mpipov
