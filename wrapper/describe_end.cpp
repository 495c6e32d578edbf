#include "describe_end.h"

#include "povray_text.h"

#include <fmt/format.h>

#include <csignal>
#include <cstring>

namespace mpipov {

std::string describe_failure(std::string_view output, const Confinement& confinement) {
    return fmt::format("POV-Ray: {}{}", parse_error(output), confinement.way_out(output));
}

std::string describe_end(const ChildProcess& child, const Confinement& confinement) {
    const ChildResult& result = child.result();
    if (result.timed_out)
        return fmt::format("POV-Ray did not end within {:.0f} s (--timeout)", result.wall_seconds);
    if (result.filled_folder || result.signal == SIGXFSZ)
        return "POV-Ray was ended because it wrote more than a launch may (--disk-limit)";
    if (result.signal) {
        const char* name = ::sigabbrev_np(*result.signal);
        return fmt::format("POV-Ray was ended by signal {} (SIG{}){}", *result.signal,
                           name != nullptr ? name : "?", confinement.way_out(child.output()));
    }
    return describe_failure(child.output(), confinement);
}

}  // namespace mpipov
