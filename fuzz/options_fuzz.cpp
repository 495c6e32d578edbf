// mpipov's command line: one argument a line.
#include "entry.h"
#include "failure.h"
#include "options.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace {

using namespace mpipov;
using fuzz::require;

std::vector<std::string> arguments_of(std::string_view text) {
    std::vector<std::string> arguments;
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size());
        // An argument ends at a zero byte.
        const std::string_view line = text.substr(0, end);
        arguments.emplace_back(line.substr(0, line.find('\0')));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return arguments;
}

bool is_subsequence(const std::vector<std::string>& part, const std::vector<std::string>& whole) {
    auto at = whole.begin();
    for (const std::string& one : part) {
        at = std::find(at, whole.end(), one);
        if (at == whole.end()) return false;
        ++at;
    }
    return true;
}

void check(const Options& options, const std::vector<std::string>& arguments) {
    for (const auto& value : {options.sections, options.radiosity_scale, options.threads,
                              options.in_flight, options.slots})
        require(!value || *value >= 1, "what counts begins at 1");
    require(options.halo >= 1 && options.retries >= 0 && options.radiosity_passes >= 1 &&
                options.radiosity_passes <= 100,
            "halo, retries and passes are in their range");
    if (options.timeout_seconds)
        require(std::isfinite(*options.timeout_seconds) && *options.timeout_seconds > 0,
                "a timeout is a time");
    require(is_subsequence(options.povray_arguments, arguments),
            "POV-Ray's arguments are passed on as they are, in order");
    // Only behind a lone "--" may one of POV-Ray's begin so.
    const auto lone = std::find(arguments.begin(), arguments.end(), "--");
    const auto ours = std::count_if(arguments.begin(), lone, [](const std::string& argument) {
        return argument.starts_with("--");
    });
    const auto left =
        std::count_if(options.povray_arguments.begin(),
                      options.povray_arguments.end() -
                          (lone == arguments.end() ? 0 : std::distance(lone + 1, arguments.end())),
                      [](const std::string& argument) { return argument.starts_with("--"); });
    require(left == 0, "what begins with -- is ours");
    const bool all_default = ours == 0;
    if (all_default)
        require(!options.help && !options.resume && !options.dry_run && !options.sections &&
                    !options.timeout_seconds && options.povray == "povray",
                "without options of ours all are as preset");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::vector<std::string> arguments = arguments_of(fuzz::as_text(data, size));
    try {
        check(parse_options(arguments), arguments);
    } catch (const Failure& failure) {
        require(failure.code() == Exit::usage && failure.what()[0] != '\0',
                "what is wrong with options is bad usage, and said");
    }
    return 0;
}
