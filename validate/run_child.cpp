#include "run_child.h"

#include "interrupt.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <array>

namespace mpipov {

ChildResult run_child(const ChildRequest& request, std::string* output) {
    constexpr int interrupt_check_milliseconds = 50;
    try {
        ChildProcess child = ChildProcess::start(request);
        while (!child.poll()) {
            throw_if_interrupted();
            std::array<pollfd, 2> set{
                {{child.output_fd(), POLLIN, 0}, {child.exit_fd(), POLLIN, 0}}};
            ::poll(set.data(), set.size(),
                   std::min(child.wait_milliseconds(), interrupt_check_milliseconds));
        }
        if (output != nullptr) *output = child.output();
        return child.result();
    } catch (const Failure&) {
        throw;
    } catch (const std::exception& error) {
        throw Failure(Exit::file, error.what());
    }
}

std::string povray_not_found(const std::string& povray) {
    return fmt::format("cannot start '{}': is POV-Ray installed, or named with --povray?", povray);
}

std::string mpiexec_not_found(const std::string& mpiexec) {
    return fmt::format("cannot start '{}': is MPI installed, or named with --mpiexec?", mpiexec);
}

Failure mpipov_failure(const ChildResult& result, const std::string& output,
                       const std::string& mpiexec) {
    if (result.exit_code == 127) return {Exit::file, mpiexec_not_found(mpiexec)};
    const std::string why = result.signal ? fmt::format("ended by signal {}", *result.signal)
                                          : fmt::format("mpipov failed: {}", last_line(output));
    for (const Exit code : {Exit::usage, Exit::file})
        if (result.exit_code == static_cast<int>(code)) return {code, why};
    return {Exit::scene, why};
}

std::string last_line(std::string_view text) {
    const std::size_t end = text.find_last_not_of(" \n\r\t");
    if (end == std::string_view::npos) return "it printed nothing";
    text = text.substr(0, end + 1);
    const std::size_t start = text.find_last_of('\n');
    return std::string(start == std::string_view::npos ? text : text.substr(start + 1));
}

}  // namespace mpipov
