// A radiosity cache on its way between ranks, in pieces that fit into a message.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mpipov {

// The next piece of `text` from `offset`, which moves on; nothing at its end.
std::optional<std::vector<std::byte>> next_piece(std::string_view text, std::size_t& offset);

// What a rank was sent, as a file that POV-Ray reads.
class ReceivedCache {
  public:
    // `bytes` are to come; with none there is no file. Throws Failure(Exit::file).
    void begin(const std::filesystem::path& file, std::size_t bytes);
    // Throws std::runtime_error where that is more than was announced, Failure(Exit::file).
    void take(const std::vector<std::byte>& piece);

    bool complete() const { return received_ == announced_; }
    // Empty where there is none.
    const std::filesystem::path& file() const { return file_; }
    std::size_t bytes() const { return announced_; }

  private:
    std::filesystem::path file_;
    std::ofstream out_;
    std::size_t announced_ = 0, received_ = 0;
};

// No more is taken of one launch: it lies in memory, here and on rank 0.
constexpr std::size_t max_samples_bytes = std::size_t{1} << 30;

// What POV-Ray wrote to `file` behind the `known` bytes that were there before; nothing where there
// is no file, as where nothing in a section is lit. `calculated`: how many samples it says that it
// took. Throws Failure(Exit::file) where it cannot be read, is shorter, is longer than may be,
// holds a line that is no sample, or holds fewer: where a disk is full POV-Ray saves what fits, and
// exits with 0.
std::string read_new_samples(const std::filesystem::path& file, std::size_t known,
                             long long calculated);

}  // namespace mpipov
