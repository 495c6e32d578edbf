#include "povray_lines.h"

#include <algorithm>
#include <charconv>

namespace mpipov {
namespace {

// Not those of <cctype>, which go by the locale.
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_upper(char c) {
    return c >= 'A' && c <= 'Z';
}
bool is_lower(char c) {
    return c >= 'a' && c <= 'z';
}
bool is_letter(char c) {
    return is_upper(c) || is_lower(c);
}
bool is_space(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

// Where the characters from `at` on end that are all `good`.
template <class Good>
std::size_t end_of(std::string_view text, std::size_t at, const Good& good) {
    while (at < text.size() && good(text[at])) ++at;
    return at;
}

// (?:[A-Z][a-z]+ )*Warning:<blank> at the start.
bool begins_with_warning(std::string_view text) {
    while (!text.starts_with("Warning: ")) {
        if (text.empty() || !is_upper(text[0])) return false;
        const std::size_t end = end_of(text, 1, is_lower);
        if (end == 1 || end == text.size() || text[end] != ' ') return false;
        text.remove_prefix(end + 1);
    }
    return true;
}

}  // namespace

void parse_counters(std::string_view line, std::map<std::string, long long>& counters) {
    std::size_t begin = 0;  // of what no counter has taken yet
    for (std::size_t colon = line.find(':'); colon != std::string_view::npos;
         colon = line.find(':', colon + 1)) {
        const std::size_t number = end_of(line, colon + 1, [](char c) { return c == ' '; });
        const std::size_t end = end_of(line, number, is_digit);
        // The longest name that ends here.
        std::size_t name = colon;
        while (name > begin && (is_letter(line[name - 1]) || line[name - 1] == ' ')) --name;
        name = static_cast<std::size_t>(
            std::find_if(line.begin() + static_cast<std::ptrdiff_t>(name),
                         line.begin() + static_cast<std::ptrdiff_t>(colon), is_upper) -
            line.begin());
        if (number == colon + 1 || end == number || colon < name + 2 || !is_letter(line[colon - 1]))
            continue;
        long long value = 0;
        std::from_chars(line.data() + number, line.data() + end, value);
        counters[std::string(line.substr(name, colon - name))] = value;
        begin = end;
    }
}

bool is_warning(std::string_view line) {
    if (begins_with_warning(line)) return true;
    if (!line.starts_with("File '")) return false;
    // A file's name may hold all of this too.
    constexpr std::string_view behind_name = "' line ";
    for (std::size_t at = line.find(behind_name, 6); at != std::string_view::npos;
         at = line.find(behind_name, at + 1)) {
        const std::size_t number = at + behind_name.size();
        const std::size_t end = end_of(line, number, is_digit);
        if (end > number && line.substr(end).starts_with(": ") &&
            begins_with_warning(line.substr(end + 2)))
            return true;
    }
    return false;
}

bool is_possible_error(std::string_view line) {
    constexpr std::string_view possible = "Possible ", error = "Error: ";
    for (std::size_t at = line.find(possible); at != std::string_view::npos;
         at = line.find(possible, at + 1)) {
        // The words between end at the colon.
        const std::size_t words = at + possible.size();
        const std::size_t end =
            end_of(line, words, [](char c) { return is_letter(c) || c == ' '; });
        const std::size_t last = error.size() - 2;  // "Error"
        if (end >= words + last && line.substr(end - last).starts_with(error)) return true;
        // What follows within these words ends where they do.
        at = std::max(at, end > 0 ? end - 1 : at);
    }
    return false;
}

std::optional<std::string_view> version_in(std::string_view text) {
    constexpr std::string_view names[] = {"POV-Ray ",
                                          "Persistence of Vision(tm) Ray Tracer Version "};
    for (std::size_t line = 0; line < text.size();) {
        const std::string_view rest = text.substr(line);
        for (const std::string_view name : names) {
            if (!rest.starts_with(name)) continue;
            const std::size_t end = end_of(rest, name.size(), [](char c) { return !is_space(c); });
            if (end > name.size() && is_digit(rest[name.size()]))
                return rest.substr(name.size(), end - name.size());
        }
        const std::size_t feed = rest.find('\n');
        if (feed == std::string_view::npos) break;
        line += feed + 1;
    }
    return {};
}

}  // namespace mpipov
