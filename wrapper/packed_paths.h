// How the names that a scene and its options use find the same files in a packed copy. Pure.
//
// The copy repeats the part of the file tree that holds the current folder, the scene's files and
// the library paths. POV-Ray is started in the copy of the current folder, so that relative names,
// also those with "..", lead to the same files. Absolute names in options and INI files are made
// relative to the current folder; in the scene's own text they stay as they are.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mpipov {

class PackedPaths {
  public:
    // `folder`: the current one, absolute. `folders` and `files`: what else the copy is to hold,
    // as it was named, relative to that one or absolute.
    PackedPaths(std::filesystem::path folder, const std::vector<std::filesystem::path>& folders,
                const std::vector<std::filesystem::path>& files);

    // The name in the pack of a file or folder, as it was named.
    std::string name_of(const std::filesystem::path& named) const;

    // An argument of POV-Ray's or a line of an INI file, with its absolute names made relative.
    std::string mapped_option(const std::string& option) const;
    // A whole INI file; the same bytes where it has none.
    std::string mapped_ini(std::string_view text) const;

  private:
    std::filesystem::path absolute(const std::filesystem::path& named) const;
    std::string mapped_line(std::string_view line) const;
    std::string mapped_name(const std::string& name) const;

    std::filesystem::path folder_, root_;
};

}  // namespace mpipov
