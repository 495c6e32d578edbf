#include "launch_failure.h"

#include "povray_text.h"

#include <fmt/format.h>

#include <cstring>
#include <system_error>
#include <utility>

namespace mpipov {

LaunchFailure launch_failure(const ChildProcess& child, const std::filesystem::path& folder,
                             std::uintmax_t frame_bytes) {
    const ChildResult& result = child.result();
    if (result.timed_out)
        return {
            fmt::format("POV-Ray did not end within {:.6g} s (--timeout)", result.timeout_seconds)};
    if (result.signal) {
        const char* name = ::sigabbrev_np(*result.signal);
        return blame_full_disk({fmt::format("POV-Ray was ended by signal {} (SIG{})",
                                            *result.signal, name != nullptr ? name : "?")},
                               folder, frame_bytes);
    }
    return blame_full_disk({fmt::format("POV-Ray: {}", parse_error(child.output()))}, folder,
                           frame_bytes);
}

LaunchFailure blame_full_disk(LaunchFailure failure, const std::filesystem::path& folder,
                              std::uintmax_t frame_bytes) {
    std::error_code error;
    const std::filesystem::space_info space = std::filesystem::space(folder, error);
    if (error || space.capacity == 0 || space.available >= frame_bytes) return failure;
    return {
        fmt::format("{}; of {} KiB that its files may take '{}' has {} left: set TMPDIR to a "
                    "folder with more room",
                    failure.why, frame_bytes >> 10,
                    std::filesystem::temp_directory_path(error).string(), space.available >> 10),
        Exit::file};
}

}  // namespace mpipov
