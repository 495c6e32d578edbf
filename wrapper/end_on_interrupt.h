// For calls that wait on somebody else and look at no signal: MPI_Init and MPI_Finalize wait for
// hydra, which the same signal may have stopped from answering. Two ranks were seen to wait in
// MPI_Init for ever.
#pragma once

#include <thread>

namespace mpipov {

// While it exists, an interrupt (block_interrupts()) ends the process with this exit code, unless
// the call returns within 3 s. Nothing is cleaned up: not for where temporary files exist.
class EndOnInterrupt {
  public:
    explicit EndOnInterrupt(int code);

  private:
    std::jthread watch_;
};

}  // namespace mpipov
