// CPU seconds of processes, user and system together.
#pragma once

#include <sys/resource.h>

namespace mpipov {

inline double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

inline double cpu_seconds(const rusage& usage) {
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// `who`: as getrusage() takes it, RUSAGE_SELF or RUSAGE_THREAD.
inline double own_cpu_seconds(int who) {
    rusage usage{};
    ::getrusage(who, &usage);
    return cpu_seconds(usage);
}

}  // namespace mpipov
