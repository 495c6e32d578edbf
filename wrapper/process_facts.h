// What /proc and the clocks tell of a process of ours while it runs, and what its folder takes.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>

namespace mpipov {

// The largest resident set since exec, bytes; 0 where /proc does not tell (a zombie has none).
std::uint64_t peak_memory(pid_t process);

// User and system together, of all its threads; 0 where it is gone.
double cpu_seconds_of(pid_t process);

// Whether it, or a child of its, may still write to a regular file. True too where the kernel does
// not tell.
bool may_have_file_open(pid_t process);

// What all files below it take of the disk, bytes: holes take nothing, an empty file 4 KiB, links
// are ours. Those that come and go meanwhile count or not.
std::uint64_t disk_bytes_in(const std::filesystem::path& folder);

}  // namespace mpipov
