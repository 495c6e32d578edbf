// The end of a rank that does without MPI_Finalize, or by MPI_Abort.
#pragma once

namespace mpipov {

// Says to hydra what MPI_Finalize would say ("cmd=finalize" of PMI-1, over the descriptor that
// hydra passes in PMI_FD), or hydra ends the other ranks as soon as this one has ended. Nothing
// where the rank was not started by hydra: Slurm takes the end as it is.
void take_leave_of_hydra();

// Where the descriptor is a pipe, until its reader has read all that is in it: hydra drops what a
// rank has said where it has not read it before it hears that the rank aborts. False where it does
// not within `seconds`.
bool wait_until_read(int fd, double seconds);

}  // namespace mpipov
