#include "python_script.h"

#include "child_process.h"
#include "failure.h"
#include "interrupt.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <array>

namespace mpipov {
namespace {

std::string last_line(std::string_view text) {
    const std::size_t end = text.find_last_not_of(" \n\r\t");
    if (end == std::string_view::npos) return "it printed nothing";
    text = text.substr(0, end + 1);
    const std::size_t start = text.find_last_of('\n');
    return std::string(start == std::string_view::npos ? text : text.substr(start + 1));
}

}  // namespace

std::filesystem::path find_script(const std::string& name) {
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
    fs::path file = (here / MPIPOV_SHARE_FROM_BIN / name).lexically_normal();
    if (!fs::exists(file, error))
        throw Failure(Exit::file,
                      fmt::format("cannot find '{}': install mpipov as a whole", file.string()));
    return file;
}

void run_script(const std::string& name, const std::vector<std::string>& arguments) {
    constexpr int interrupt_check_milliseconds = 50;
    ChildRequest request;
    request.argv = {MPIPOV_PYTHON, find_script(name).string()};
    request.argv.insert(request.argv.end(), arguments.begin(), arguments.end());
    request.environment = {{"PYTHONDONTWRITEBYTECODE", "1"}};
    try {
        ChildProcess child = ChildProcess::start(request);
        while (!child.poll()) {
            throw_if_interrupted();
            std::array<pollfd, 2> set{
                {{child.output_fd(), POLLIN, 0}, {child.exit_fd(), POLLIN, 0}}};
            ::poll(set.data(), set.size(),
                   std::min(child.wait_milliseconds(), interrupt_check_milliseconds));
        }
        if (child.result().exit_code != 0)
            throw Failure(Exit::file, fmt::format("{} {} failed: {}", MPIPOV_PYTHON, name,
                                                  last_line(child.output())));
    } catch (const Failure&) {
        throw;
    } catch (const std::exception& error) {
        throw Failure(Exit::file, error.what());
    }
}

}  // namespace mpipov
