// Starting a child process through mpipov-guard (see child_process.h).
#pragma once

#include "child_process.h"
#include "fd.h"

namespace mpipov {

struct Spawned {
    pid_t pid = -1;  // the leader of a process group of its own
    Fd output;       // non-blocking: stdout and stderr, merged
    Fd exit;         // pidfd; empty where the kernel has none
};

// Throws as ChildProcess::start does.
Spawned spawn_guarded(const ChildRequest& request);

}  // namespace mpipov
