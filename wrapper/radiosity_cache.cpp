#include "radiosity_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace mpipov {
namespace {

// "C1" and so on by the depth of the bounce, then ten columns of numbers.
constexpr auto columns = 10;

bool is_sample(std::string_view line) {
    const std::string_view kind = line.substr(0, line.find('\t'));
    return kind.size() > 1 && kind[0] == 'C' &&
           kind.find_first_not_of("0123456789", 1) == std::string_view::npos &&
           std::ranges::count(line, '\t') == columns &&
           line.find_first_not_of("0123456789abcdefinx+-.\t\r", 1) == std::string_view::npos;
}

}  // namespace

std::vector<std::string_view> samples_of(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const auto end = text.find('\n');
        const std::string_view line = text.substr(0, end);
        // The last line of a file that was cut short would be a wrong sample.
        if (end == std::string_view::npos || !is_sample(line))
            throw std::runtime_error(
                fmt::format("a radiosity cache of POV-Ray has a line that is no sample: '{}'",
                            line.substr(0, 60)));
        lines.push_back(line);
        text.remove_prefix(end + 1);
    }
    return lines;
}

void RadiosityCache::add(std::string_view text) {
    for (const std::string_view line : samples_of(text))
        if (known_.emplace(line).second) (text_ += line) += '\n';
}

}  // namespace mpipov
