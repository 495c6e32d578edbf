#include "python_script.h"

#include "failure.h"
#include "run_child.h"

#include <fmt/format.h>

namespace mpipov {

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
    ChildRequest request;
    request.argv = {MPIPOV_PYTHON, find_script(name).string()};
    request.argv.insert(request.argv.end(), arguments.begin(), arguments.end());
    request.environment = {{"PYTHONDONTWRITEBYTECODE", "1"}};
    std::string output;
    if (run_child(request, &output).exit_code != 0)
        throw Failure(Exit::file,
                      fmt::format("{} {} failed: {}", MPIPOV_PYTHON, name, last_line(output)));
}

}  // namespace mpipov
