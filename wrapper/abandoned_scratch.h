// Temporary folders of processes that were killed: SIGKILL leaves nobody to remove them.
#pragma once

#include "fd.h"

#include <filesystem>
#include <string>

namespace mpipov {

// A name that ScratchFolder gives: "mpipov-PURPOSE.XXXXXX".
bool is_scratch_name(const std::string& name);

// Marks the folder as ScratchFolder's (its set-user-ID bit, which means nothing to a folder and
// nobody else sets) and as in use until the descriptor is closed, which the kernel does at the end
// of the process however it ends. None where the file system knows no locks: then it is never
// removed here.
Fd hold(const std::filesystem::path& folder);

// Removes the folders in `base` that have such a name and mark, are this user's alone, were made
// more than `seconds` ago (one that is younger may not be held yet), and that nobody holds. Only on
// a file system of this machine: elsewhere a lock of another host's might not be seen. Errors are
// left to whoever needs the space.
void remove_abandoned_scratch(const std::filesystem::path& base, double seconds);

}  // namespace mpipov
