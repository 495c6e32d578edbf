#include "povray_text.h"

#include "povray_lines.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <iterator>
#include <regex>
#include <unordered_set>

namespace mpipov {
namespace {

constexpr std::size_t wrap_column = 80;
// POV-Ray looks for a space in the last quarter of the line only.
constexpr std::size_t shortest_wrapped_line = wrap_column * 3 / 4;
// Of what regular expressions are asked: they recurse once a character (povray_lines.h). What they
// look for is shorter, but for the file's name of the output line.
constexpr std::size_t longest_searched = 512;
constexpr std::string_view missing_file = "Error: Cannot find file '";
constexpr std::string_view option_problem = "Problem with option setting";

std::vector<std::string> split_lines(std::string_view text) {
    std::vector<std::string> lines;
    std::size_t begin = 0;
    while (begin <= text.size()) {
        std::size_t end = text.find_first_of("\r\n", begin);
        if (end == std::string_view::npos) end = text.size();
        lines.emplace_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return lines;
}

// How POV-Ray begins a message, a heading or an entry of a table.
bool begins_anew(const std::string& line) {
    for (const std::string_view start : {"File '", "Parse ", "Possible ", "Fatal error", "Render",
                                         "POV-Ray ", "Parser Options", "====", "----", "  "})
        if (line.rfind(start, 0) == 0) return true;
    return false;
}

bool continues(const std::string& line, const std::string& next) {
    // A line that just fills the columns looks like one that was broken there.
    if (line.size() >= wrap_column) return !begins_anew(next);
    return line.size() >= shortest_wrapped_line && next.size() > 1 && next[0] == ' ' &&
           next[1] != ' ';
}

std::string trim(std::string_view text) {
    const auto begin = text.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos) return {};
    return std::string(text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1));
}

int to_int(const std::string& text) {
    int value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

double to_double(const std::string& text) {
    double value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

std::optional<std::string> value_after(const std::string& line, std::string_view label) {
    if (line.rfind(label, 0) != 0) return {};
    return trim(std::string_view(line).substr(label.size()));
}

// "out.png, 24 bpp PNG" | "out.exr, 48 bpp with alpha EXR" | "out.png, grayscale PNG" |
// "out.jpg, 24 bpp, quality 85% JPEG" | "out.tga, 24 bpp RLE Targa" |
// "out.jpg, 32 bpp, quality 85% with alpha JPEG"
void parse_output_line(const std::string& value, ImageOptions& options) {
    static const std::regex shape(
        R"(^(?:(\d+) bpp|grayscale)(?:, quality (\d+)%)?( with alpha)?(?:, quality (\d+)%)? )"
        R"((RLE )?(\S+)$)");
    std::smatch match;
    // The name may hold ", " too: from behind, the first place from which all that follows fits.
    constexpr std::string_view separator = ", ";
    std::string behind;
    std::size_t name_end = value.size();
    do {
        if (name_end == 0) return;
        name_end = value.rfind(separator, name_end - 1);
        if (name_end == std::string::npos || value.size() - name_end > longest_searched) return;
        behind = value.substr(name_end + separator.size());
    } while (!std::regex_match(behind, match, shape));
    options.output_file = value.substr(0, name_end);
    options.to_standard_output = options.output_file == "stdout";
    options.bits_per_pixel = to_int(match[1]);
    options.alpha = match[3].matched;
    options.jpeg_quality = to_int(match[2].matched ? match[2] : match[4]);
    options.rle = match[5].matched;
    options.type = match[6];
}

// The time in brackets of "  Parse Time:   0 hours  0 minutes  0 seconds (0.014 seconds)".
std::optional<double> bracketed_seconds(const std::string& line) {
    static const std::regex shape(R"(\(([0-9.]+) seconds\))");
    std::smatch match;
    if (line.size() > longest_searched || !std::regex_search(line, match, shape)) return {};
    return to_double(match[1]);
}

double cpu_seconds(const std::string& line) {
    static const std::regex shape(R"(with ([0-9.]+) CPU-seconds)");
    std::smatch match;
    return line.size() <= longest_searched && std::regex_search(line, match, shape)
               ? to_double(match[1])
               : 0.0;
}

void parse_antialiasing(const std::string& value, Antialiasing& antialiasing) {
    static const std::regex shape(R"(\(Method (\d+), Threshold ([0-9.]+), Depth (\d+))");
    std::smatch match;
    antialiasing.on = value.rfind("On", 0) == 0;
    if (value.size() > longest_searched || !std::regex_search(value, match, shape)) return;
    antialiasing.method = to_int(match[1]);
    antialiasing.threshold = to_double(match[2]);
    antialiasing.depth = to_int(match[3]);
}

}  // namespace

std::vector<std::string> unwrap_lines(std::string_view text) {
    std::vector<std::string> lines;
    std::string last_piece;  // as printed: whether a line goes on is told by its printed length
    for (std::string& line : split_lines(text)) {
        if (!lines.empty() && continues(last_piece, line))
            lines.back() += line;
        else
            lines.push_back(line);
        last_piece = std::move(line);
    }
    return lines;
}

std::optional<ImageOptions> parse_image_options(std::string_view text) {
    static const std::regex resolution(
        R"(^(\d+) by (\d+) \(rows (\d+) to (\d+), columns (\d+) to (\d+)\)\.?$)");
    static const std::regex frames(R"(^Rendering frame \d+ of (\d+))");
    ImageOptions options;
    bool found = false;
    for (const std::string& line : unwrap_lines(text)) {
        std::smatch match;
        if (const auto value = value_after(line, "  Image resolution.....")) {
            if (value->size() > longest_searched || !std::regex_match(*value, match, resolution))
                continue;
            options.width = to_int(match[1]);
            options.height = to_int(match[2]);
            options.region = {to_int(match[5]) - 1, to_int(match[3]) - 1, to_int(match[6]),
                              to_int(match[4])};
            found = true;
        } else if (const auto file = value_after(line, "  Output file..........")) {
            parse_output_line(*file, options);
        } else if (const auto dithering = value_after(line, "  Dithering............")) {
            options.dithering = *dithering;
        } else if (const auto input = value_after(line, "  Input file: ")) {
            options.input_file = *input;
        } else if (line.size() <= longest_searched && std::regex_search(line, match, frames)) {
            options.animation = true;
            options.frames = to_int(match[1]);
        }
    }
    if (!found) return {};
    return options;
}

LaunchReport parse_report(std::string_view text) {
    LaunchReport report;
    double* cpu = nullptr;  // where the next "using N thread(s) with X CPU-seconds" belongs
    for (const std::string& line : unwrap_lines(text)) {
        if (const auto value = value_after(line, "  Antialiasing.........")) {
            parse_antialiasing(*value, report.antialiasing);
        } else if (line.rfind("  Parse Time:", 0) == 0) {
            report.parse_seconds = bracketed_seconds(line).value_or(0);
            cpu = &report.parse_cpu;
        } else if (line.rfind("  Bounding Time:", 0) == 0) {
            cpu = nullptr;
        } else if (line.rfind("  Photon Time:", 0) == 0) {
            const auto seconds = bracketed_seconds(line);
            report.photons = seconds.has_value();
            report.photon_seconds = seconds.value_or(0);
            cpu = &report.photon_cpu;
        } else if (line.rfind("  Radiosity Time:", 0) == 0) {
            const auto seconds = bracketed_seconds(line);
            report.radiosity = seconds.has_value();
            report.radiosity_seconds = seconds.value_or(0);
            cpu = &report.radiosity_cpu;
        } else if (line.rfind("  Trace Time:", 0) == 0) {
            report.trace_seconds = bracketed_seconds(line).value_or(0);
            cpu = &report.trace_cpu;
        } else if (line.find("CPU-seconds") != std::string::npos) {
            if (cpu != nullptr) *cpu = cpu_seconds(line);
            cpu = nullptr;
        } else if (line.rfind("POV-Ray finished", 0) == 0) {
            report.finished = true;
        } else {
            parse_counters(line, report.counters);
        }
    }
    return report;
}

bool statistics_are_printed(std::string_view text) {
    // Asked again and again of a text that grows: only POV-Ray's farewell comes after them.
    constexpr std::size_t enough = 4096;
    text.remove_prefix(text.size() - std::min(text.size(), enough));
    const std::size_t last = text.rfind("\n  Trace Time:");
    return last != std::string_view::npos &&
           text.find(" CPU-seconds total\n", last) != std::string_view::npos;
}

std::optional<double> parse_progress(std::string_view text) {
    static const std::regex shape(R"(^Rendered (\d+) of (\d+) pixels)");
    // The very last one may still be on its way.
    for (auto at = text.rfind("Rendered "); at != std::string_view::npos;
         at = at > 0 ? text.rfind("Rendered ", at - 1) : std::string_view::npos) {
        const std::string piece(text.substr(at, wrap_column));
        std::smatch match;
        if (!std::regex_search(piece, match, shape)) continue;
        const double all = to_double(match[2]);
        return all > 0 ? std::optional(to_double(match[1]) / all) : std::nullopt;
    }
    return {};
}

std::vector<std::string> parse_warnings(std::string_view text) {
    std::vector<std::string> warnings;
    std::unordered_set<std::string> known;  // there may be as many as there are lines
    for (const std::string& line : unwrap_lines(text)) {
        if (!is_warning(line)) continue;
        std::string warning = trim(line);
        if (known.insert(warning).second) warnings.push_back(std::move(warning));
    }
    return warnings;
}

std::string parse_error(std::string_view text) {
    constexpr std::string_view general[] = {"Fatal error", "Cannot", "Failed", "No input file"};
    // These lines are not wrapped: the problem, the whole command, the reason.
    const std::vector<std::string> printed = split_lines(text);
    for (std::size_t i = 0; i + 2 < printed.size(); ++i)
        if (printed[i].rfind(option_problem, 0) == 0)
            return trim(printed[i]) + ": " + trim(printed[i + 2]);
    const std::vector<std::string> lines = unwrap_lines(text);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].find("Error: ") == std::string::npos || is_possible_error(lines[i])) continue;
        // Right before "Cannot open input file." stands which file, as a possible error.
        return trim(i > 0 && is_possible_error(lines[i - 1]) ? lines[i - 1] : lines[i]);
    }
    const auto reason = std::find_if(lines.begin(), lines.end(), [&](const std::string& line) {
        return std::any_of(std::begin(general), std::end(general),
                           [&](std::string_view start) { return line.starts_with(start); });
    });
    if (reason != lines.end()) {
        // Of an image or a font that is not there, only a possible error says which.
        const auto file =
            std::find_if(std::reverse_iterator(reason), lines.rend(), [](const std::string& line) {
                return is_possible_error(line) && line.find(missing_file) != std::string::npos;
            });
        const bool is_named = file != lines.rend() && reason->ends_with("Cannot open file.");
        return trim(is_named ? *file : *reason);
    }
    for (auto line = lines.rbegin(); line != lines.rend(); ++line)
        if (!trim(*line).empty()) return trim(*line);
    return "it printed nothing";
}

bool is_option_error(std::string_view text) {
    return text.find(option_problem) != std::string_view::npos;
}

std::optional<std::string> parse_version(std::string_view text) {
    const auto version = version_in(text);
    return version ? std::optional(std::string(*version)) : std::nullopt;
}

IniSettings ini_settings(std::string_view text) {
    IniSettings settings;
    for (const std::string& line : split_lines(text)) {
        const auto equals = line.find('=');
        if (equals == std::string::npos || line[0] == ';') continue;
        std::string value = trim(std::string_view(line).substr(equals + 1));
        if (value.size() >= 2 && value.front() == '"' && value.back() == '"')
            value = value.substr(1, value.size() - 2);
        settings.emplace_back(trim(std::string_view(line).substr(0, equals)), value);
    }
    return settings;
}

std::map<std::string, std::string> parse_ini(std::string_view text) {
    std::map<std::string, std::string> values;
    for (auto [key, value] : ini_settings(text)) {
        std::transform(key.begin(), key.end(), key.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        values[key] = std::move(value);
    }
    return values;
}

long long radiosity_samples(std::string_view text) {
    const auto counters = parse_report(text).counters;
    const auto found = counters.find("Radiosity samples calculated");
    return found == counters.end() ? 0 : found->second;
}

}  // namespace mpipov
