// Writing a file so that it is there as a whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace mpipov {

// A pipe or a device (/dev/null): it stays what it is.
bool is_written_into(const std::filesystem::path& target);

// Where the links lead that stand at the end of `file`, though nothing be there yet. Throws
// Failure(Exit::file) where they lead in a circle.
std::filesystem::path end_of_links(const std::filesystem::path& file);

// An empty file of a short name of its own in the folder of `target` (which may have the longest
// name that a file can have); a reader that looks for images does not see it. What has not taken
// the target's place in the end is removed.
//
// As with any program that opens its output, a link is followed. What is_written_into() gets the
// bytes of a part in the temporary folder.
class PartFile {
  public:
    // Throws Failure(Exit::file) that names the target and the reason.
    explicit PartFile(const std::filesystem::path& target);
    ~PartFile();
    PartFile(const PartFile&) = delete;
    PartFile& operator=(const PartFile&) = delete;

    const std::filesystem::path& path() const { return part_; }
    // Renames; an earlier target is replaced. Throws as above, and Failure(Exit::interrupted) while
    // it waits for the reader of a pipe.
    void take_place();

  private:
    void write_into_place() const;

    bool into_ = false;             // no regular file: it is written into
    std::filesystem::path target_;  // where links lead
    std::filesystem::path part_;
};

// Throws as PartFile.
void write_whole(const std::filesystem::path& target, std::string_view text);

}  // namespace mpipov
