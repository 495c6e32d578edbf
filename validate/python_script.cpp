#include "python_script.h"

#include "failure.h"
#include "run_child.h"
#include "shipped_file.h"

#include <fmt/format.h>

namespace mpipov {

void run_script(const std::string& name, const std::vector<std::string>& arguments) {
    ChildRequest request;
    request.argv = {MPIPOV_PYTHON,
                    shipped_file(std::filesystem::path(MPIPOV_SHARE_FROM_BIN) / name).string()};
    request.argv.insert(request.argv.end(), arguments.begin(), arguments.end());
    request.environment = {{"PYTHONDONTWRITEBYTECODE", "1"}};
    std::string output;
    if (run_child(request, &output).exit_code != 0)
        throw Failure(Exit::file,
                      fmt::format("{} {} failed: {}", MPIPOV_PYTHON, name, last_line(output)));
}

}  // namespace mpipov
