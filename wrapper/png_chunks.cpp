#include "png_chunks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace mpipov {
namespace {

constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";
constexpr std::size_t crc_size = 4;

// A chunk's length is stored with its most significant byte first.
std::uint32_t chunk_length(std::span<const std::byte, 8> header) {
    std::uint32_t value = 0;
    for (const std::byte b : header.first<4>())
        value = value << 8 | std::to_integer<std::uint32_t>(b);
    return value;
}

std::string chunk_type(std::span<const std::byte, 8> header) {
    std::string type;
    for (const std::byte b : header.last<4>()) type.push_back(std::to_integer<char>(b));
    return type;
}

bool belongs_to_pixels(std::string_view type) {
    return type == "IHDR" || type == "PLTE" || type == "IDAT" || type == "IEND";
}

std::span<char> as_chars(std::span<std::byte> bytes) {
    return {reinterpret_cast<char*>(bytes.data()), bytes.size()};
}

bool read_exactly(std::istream& stream, std::span<std::byte> bytes) {
    const auto chars = as_chars(bytes);
    return static_cast<bool>(stream.read(chars.data(), static_cast<std::streamsize>(chars.size())));
}

}  // namespace

std::vector<PngChunk> read_png_metadata(const std::filesystem::path& file) {
    const auto fail = [&](std::string_view why) {
        throw std::runtime_error(fmt::format("cannot read '{}': {}", file.string(), why));
    };
    std::ifstream stream(file, std::ios::binary);
    if (!stream) fail(std::strerror(errno));
    std::array<std::byte, signature.size()> start{};
    if (!read_exactly(stream, start) || !std::ranges::equal(as_chars(start), signature))
        fail("not a PNG file");
    const std::uintmax_t size = std::filesystem::file_size(file);

    std::vector<PngChunk> metadata;
    bool after_pixels = false;
    std::uintmax_t position = signature.size();
    for (;;) {
        std::array<std::byte, 8> header{};
        if (!read_exactly(stream, header)) fail("truncated: no IEND chunk");
        const std::uint32_t length = chunk_length(header);
        const std::string type = chunk_type(header);
        position += header.size() + length + crc_size;
        if (position > size) fail(fmt::format("truncated in its {} chunk", type));
        if (type == "IEND") return metadata;
        if (type == "IDAT") after_pixels = true;
        if (belongs_to_pixels(type)) {
            stream.seekg(static_cast<std::streamoff>(position));
            continue;
        }
        PngChunk chunk{.type = type, .bytes = {}, .after_pixels = after_pixels};
        chunk.bytes.resize(header.size() + length + crc_size);
        std::ranges::copy(header, chunk.bytes.begin());
        if (!read_exactly(stream, std::span(chunk.bytes).subspan(header.size())))
            fail(fmt::format("truncated in its {} chunk", type));
        metadata.push_back(std::move(chunk));
    }
}

PngMetadataFilter::PngMetadataFilter(std::vector<PngChunk> metadata, Sink sink)
    : metadata_(std::move(metadata)), sink_(std::move(sink)) {}

void PngMetadataFilter::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        if (left_ > 0) {
            const auto piece = bytes.first(std::min<std::uint64_t>(left_, bytes.size()));
            if (pass_) sink_(piece);
            left_ -= piece.size();
            bytes = bytes.subspan(piece.size());
            if (left_ == 0 && last_) complete_ = true;
            continue;
        }
        header_.at(header_filled_++) = bytes.front();
        bytes = bytes.subspan(1);
        if (header_filled_ == header_.size()) start_chunk();
    }
}

void PngMetadataFilter::start_chunk() {
    const std::string type = chunk_type(header_);
    if (type == "IDAT" && !std::exchange(pixels_seen_, true)) insert(false);
    if (type == "IEND") {
        insert(true);
        last_ = true;
    }
    pass_ = belongs_to_pixels(type);
    if (pass_) sink_(header_);
    left_ = std::uint64_t{chunk_length(header_)} + crc_size;
    header_filled_ = 0;
}

void PngMetadataFilter::insert(bool after_pixels) {
    for (const PngChunk& chunk : metadata_)
        if (chunk.after_pixels == after_pixels) sink_(chunk.bytes);
}

}  // namespace mpipov
