// Shapes that a line of POV-Ray's may have, whatever its length: a scene prints what it likes
// (#debug, #warning), and std::regex recurses once a character, which overflows the stack at some
// ten thousand. Linear in the length. The regular expressions that they stand for:
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace mpipov {

// ([A-Z][A-Za-z ]*[A-Za-z]): +(\d+), each of a line; a number that does not fit is 0.
void parse_counters(std::string_view line, std::map<std::string, long long>& counters);

// ^(?:File '.*' line \d+: )?(?:[A-Z][a-z]+ )*Warning:<blank>
bool is_warning(std::string_view line);

// Possible [A-Za-z ]*Error:<blank>
bool is_possible_error(std::string_view line);

// The version after (?:^|\n)POV-Ray<blank> or the banner; (\d[^\s]*)
std::optional<std::string_view> version_in(std::string_view text);

}  // namespace mpipov
