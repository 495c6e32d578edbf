// What tells whether a file is the same as another, without reading very large ones as a whole: the
// one rule for --resume and for files of another host.
#pragma once

#include <filesystem>
#include <string>

namespace mpipov {

// Of at most 1 GiB: its SHA-1. Of more: its size, and the SHA-1 of 64 pieces of 1 MiB in equal
// steps, the first and the last MiB among them; so whoever must know of any change at all asks for
// the time of it too. Empty where it cannot be read.
std::string fingerprint(const std::filesystem::path& file);

// Whether that is the SHA-1 of the whole file.
bool is_of_whole_file(const std::string& fingerprint);

}  // namespace mpipov
