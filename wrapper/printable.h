// Text of somebody else's (POV-Ray's, a scene's, a file's name) for a terminal.
#pragma once

#include <string>
#include <string_view>

namespace mpipov {

// With '?' for each control character (ASCII's, and those of Latin 1 in UTF-8), which could move
// the cursor, set the title or worse; a tab becomes a blank. Line feeds stay. All else stays as it
// is.
std::string printable(std::string_view text);

}  // namespace mpipov
