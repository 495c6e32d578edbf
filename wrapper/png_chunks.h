// PNG files chunk by chunk (PNG specification, 5.3 "Chunk layout": length, type, data, CRC).
// Lets a PNG that one program compressed carry the metadata that another one wrote: chunks are
// copied whole, with their CRC. The pixels stay untouched, so only chunks that do not depend on
// them (gAMA, sRGB, sBIT, tEXt...) may come from elsewhere.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace mpipov {

struct PngChunk {
    std::string type;              // four letters
    std::vector<std::byte> bytes;  // length, type, data and CRC, as in the file
    bool after_pixels = false;     // it stands behind the IDAT chunks
};

// All chunks of `file` but IHDR, PLTE, IDAT and IEND, in their order.
// Throws std::runtime_error naming the file, when it is missing, truncated or no PNG.
std::vector<PngChunk> read_png_metadata(const std::filesystem::path& file);

// Takes a PNG as a stream, in pieces of any size, and passes it on to `sink` with `metadata` in the
// place of all of its own chunks but IHDR, PLTE, IDAT and IEND.
class PngMetadataFilter {
  public:
    using Sink = std::function<void(std::span<const std::byte>)>;

    PngMetadataFilter(std::vector<PngChunk> metadata, Sink sink);
    void write(std::span<const std::byte> bytes);

    // The stream ended with a whole IEND chunk.
    bool complete() const { return complete_; }

  private:
    static constexpr std::size_t signature_size = 8;

    void start_chunk();
    void insert(bool after_pixels);

    std::vector<PngChunk> metadata_;
    Sink sink_;
    std::array<std::byte, 8> header_{};  // length and type of the chunk that begins
    std::size_t header_filled_ = 0;
    std::uint64_t left_ = signature_size;  // bytes up to the next chunk, to be passed on or dropped
    bool pass_ = true;
    bool pixels_seen_ = false;
    bool last_ = false;
    bool complete_ = false;
};

}  // namespace mpipov
