#include "launch_failure.h"

#include "povray_text.h"

#include <fmt/format.h>

#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

namespace mpipov {
namespace {

bool wrote_too_much(const ChildResult& result) {
    return result.filled_folder || result.signal == SIGXFSZ;
}

}  // namespace

LaunchFailure launch_failure(const ChildProcess& child, const Confinement& confinement,
                             const LaunchPlace& place) {
    const ChildResult& result = child.result();
    LaunchFailure failure{describe_failure(result, child.output(), confinement)};
    const bool limited = result.timed_out || wrote_too_much(result);
    return limited ? failure : blame_full_disk(std::move(failure), place);
}

std::string describe_failure(const ChildResult& result, std::string_view output,
                             const Confinement& confinement) {
    if (result.timed_out)
        return fmt::format("POV-Ray did not end within {:.6g} s (--timeout)",
                           result.timeout_seconds);
    if (wrote_too_much(result))
        return "POV-Ray was ended because it wrote more than a launch may (--disk-limit)";
    if (result.signal) {
        const char* name = ::sigabbrev_np(*result.signal);
        return fmt::format("POV-Ray was ended by signal {} (SIG{}){}", *result.signal,
                           name != nullptr ? name : "?", confinement.way_out(output));
    }
    return describe_failure(output, confinement);
}

std::string describe_failure(std::string_view output, const Confinement& confinement) {
    return fmt::format("POV-Ray: {}{}", parse_error(output), confinement.way_out(output));
}

LaunchFailure blame_full_disk(LaunchFailure failure, const LaunchPlace& place) {
    std::error_code error;
    const std::filesystem::space_info space = std::filesystem::space(place.folder, error);
    if (error || space.capacity == 0 || space.available >= place.frame_bytes) return failure;
    return {
        fmt::format("{}; of {} KiB that its files may take '{}' has {} left: set TMPDIR to a "
                    "folder with more room",
                    failure.why, place.frame_bytes >> 10,
                    std::filesystem::temp_directory_path(error).string(), space.available >> 10),
        Exit::file};
}

}  // namespace mpipov
