// Writing a file so that it is there as a whole or not at all.
#pragma once

#include <filesystem>

namespace mpipov {

// An empty file of a short name of its own in the folder of `target` (which may have the longest
// name that a file can have); a reader that looks for images does not see it. What has not taken
// the target's place in the end is removed.
class PartFile {
  public:
    // Throws std::runtime_error that names the target and the reason.
    explicit PartFile(std::filesystem::path target);
    ~PartFile();
    PartFile(const PartFile&) = delete;
    PartFile& operator=(const PartFile&) = delete;

    const std::filesystem::path& path() const { return part_; }
    // Renames; an earlier target is replaced. Throws as above.
    void take_place();

  private:
    std::filesystem::path target_, part_;
};

}  // namespace mpipov
