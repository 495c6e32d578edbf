// What POV-Ray prints, and its INI files.
#include "entry.h"
#include "povray_lines.h"
#include "povray_text.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <regex>
#include <set>
#include <string>

namespace {

using namespace mpipov;
using fuzz::require;

// Long ones would overflow the regular expressions' stack, which is why they are not used.
constexpr std::size_t longest_compared = 500;
constexpr std::size_t most_compared = 200;  // lines: they are slow too

std::map<std::string, long long> counters_by_regex(const std::string& line) {
    static const std::regex shape(R"(([A-Z][A-Za-z ]*[A-Za-z]): +(\d+))");
    std::map<std::string, long long> counters;
    for (std::sregex_iterator it(line.begin(), line.end(), shape), end; it != end; ++it) {
        try {
            counters[(*it)[1]] = std::stoll((*it)[2]);
        } catch (const std::out_of_range&) {
            counters[(*it)[1]] = 0;
        }
    }
    return counters;
}

void compare_with_regex(const std::string& line) {
    static const std::regex warning(R"(^(?:File '.*' line \d+: )?(?:[A-Z][a-z]+ )*Warning: )");
    static const std::regex possible(R"(Possible [A-Za-z ]*Error: )");
    std::map<std::string, long long> counters;
    parse_counters(line, counters);
    require(counters == counters_by_regex(line), "counters are those of the regular expression");
    require(is_warning(line) == std::regex_search(line, warning),
            "warnings are those of the regular expression");
    require(is_possible_error(line) == std::regex_search(line, possible),
            "possible errors are those of the regular expression");
}

void compare_version(const std::string& text) {
    static const std::regex shape(
        R"((?:^|\n)(?:POV-Ray|Persistence of Vision\(tm\) Ray Tracer Version) (\d[^\s]*))");
    std::smatch match;
    const bool found = std::regex_search(text, match, shape);
    const auto version = parse_version(text);
    require(version.has_value() == found && (!found || *version == match[1]),
            "the version is that of the regular expression");
}

std::string without_line_ends(std::string text) {
    std::erase_if(text, [](char c) { return c == '\n' || c == '\r'; });
    return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(fuzz::as_text(data, size));
    const auto lines = unwrap_lines(text);
    require(without_line_ends(text) == std::accumulate(lines.begin(), lines.end(), std::string(),
                                                       [](std::string all, const std::string& one) {
                                                           return std::move(all) + one;
                                                       }),
            "unwrapping keeps every character");
    for (std::size_t i = 0; i < std::min(lines.size(), most_compared); ++i)
        if (lines[i].size() <= longest_compared && lines[i].find('\0') == std::string::npos)
            compare_with_regex(lines[i]);
    if (text.size() <= longest_compared) compare_version(text);

    if (const auto image = parse_image_options(text))
        require(image->width >= 0 && image->height >= 0 && image->bits_per_pixel >= 0 &&
                    image->jpeg_quality >= 0 && image->region.x0 >= -1 && image->region.y0 >= -1 &&
                    image->frames >= 0,
                "image options are not negative");
    const LaunchReport report = parse_report(text);
    for (const double seconds : {report.parse_seconds, report.photon_seconds,
                                 report.radiosity_seconds, report.trace_seconds, report.parse_cpu,
                                 report.photon_cpu, report.radiosity_cpu, report.trace_cpu})
        require(std::isfinite(seconds) && seconds >= 0, "times are finite and not negative");
    for (const auto& [name, count] : report.counters)
        require(count >= 0 && name.size() >= 2, "counters have names and are not negative");
    require(radiosity_samples(text) >= 0, "samples are not negative");
    if (const auto progress = parse_progress(text))
        require(std::isfinite(*progress) && *progress >= 0, "progress is a number");
    const auto warnings = parse_warnings(text);
    require(std::set<std::string>(warnings.begin(), warnings.end()).size() == warnings.size(),
            "each warning comes once");
    require(!parse_error(text).empty(), "an error is never empty");
    if (is_option_error(text)) require(!parse_error(text).empty(), "an option error has a reason");
    if (statistics_are_printed(text))
        require(text.find("CPU-seconds total") != std::string::npos, "statistics have an end");
    require(parse_ini(text).size() <= ini_settings(text).size(), "a map has no more than the list");
    return 0;
}
