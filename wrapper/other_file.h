// Writing must not destroy what is read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mpipov {

// Throws Failure(Exit::usage) where what `option` is to write is one of the files that are read, by
// whatever name. An empty target is none.
void require_other_file(const std::string& option, const std::filesystem::path& target,
                        const std::vector<std::filesystem::path>& read);

// The same file, or that would be; empty paths are none.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace mpipov
