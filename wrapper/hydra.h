// The end of a rank that does without MPI_Finalize.
#pragma once

namespace mpipov {

// Says to hydra what MPI_Finalize would say ("cmd=finalize" of PMI-1, over the descriptor that
// hydra passes in PMI_FD), or hydra ends the other ranks as soon as this one has ended. Nothing
// where the rank was not started by hydra: Slurm takes the end as it is.
void take_leave_of_hydra();

}  // namespace mpipov
