// The lead-in of an image file: what stands before its first byte that depends on the size or the
// pixels, and says by which program and how the file was made. Files of one type that were written
// with the same settings may swap it. Of these types only:
//   hdr   the text up to the empty line (SOFTWARE=, COMMENT=, FORMAT=);
//   jpeg  the start marker and the APPn and COM segments behind it;
//   pnm   the magic number and the comments behind it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace mpipov {

// Its length, where `bytes`, the beginning of a file, holds all of it and one byte more. `type` is
// OpenImageIO's name. Throws std::invalid_argument for a type not listed above.
std::optional<std::size_t> lead_in_size(std::string_view type, std::span<const std::byte> bytes);

// Throws std::runtime_error naming the file, when it is missing or not of that type.
std::vector<std::byte> read_lead_in(std::string_view type, const std::filesystem::path& file);

// Takes a file as a stream, in pieces of any size, and passes it on to `sink` with another lead-in.
class LeadInFilter {
  public:
    using Sink = std::function<void(std::span<const std::byte>)>;

    LeadInFilter(std::string_view type, std::vector<std::byte> lead_in, Sink sink);
    void write(std::span<const std::byte> bytes);

    // The stream had a lead-in to be replaced.
    bool complete() const { return complete_; }

  private:
    std::string_view type_;
    std::vector<std::byte> lead_in_;
    Sink sink_;
    std::vector<std::byte> start_;  // what came so far, up to the end of the stream's own lead-in
    bool complete_ = false;
};

}  // namespace mpipov
