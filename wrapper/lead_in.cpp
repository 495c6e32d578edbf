#include "lead_in.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace mpipov {
namespace {

// More than POV-Ray or OpenImageIO ever write: beyond it, the file is not what it should be.
constexpr std::size_t most = std::size_t{1} << 20;

using Bytes = std::span<const std::byte>;

std::optional<std::size_t> hdr_size(Bytes bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::size_t at = text.find("\n\n");
    if (at == std::string_view::npos || at + 2 >= text.size()) return std::nullopt;
    return at + 2;
}

std::optional<std::size_t> pnm_size(Bytes bytes) {
    bool comment = false;
    for (std::size_t at = 2; at < bytes.size(); ++at) {
        const char c = std::to_integer<char>(bytes[at]);
        if (c == '#') comment = true;
        if (!comment && c >= '0' && c <= '9') return at;
        if (c == '\n') comment = false;
    }
    return std::nullopt;
}

// Segments: 0xff, a marker, and a length of two bytes, high byte first, that counts itself.
// Markers: ITU-T T.81, table B.1: APP0 to APP15 are e0 to ef, COM is fe.
std::optional<std::size_t> jpeg_size(Bytes bytes) {
    std::size_t at = 2;
    while (at + 4 <= bytes.size()) {
        const auto marker = std::to_integer<unsigned>(bytes[at + 1]);
        if ((marker < 0xe0 || marker > 0xef) && marker != 0xfe) return at;
        at += 2 + (std::to_integer<std::size_t>(bytes[at + 2]) << 8) +
              std::to_integer<std::size_t>(bytes[at + 3]);
    }
    return std::nullopt;
}

bool begins_as(std::string_view type, Bytes bytes) {
    const auto starts = [&](std::string_view magic) {
        return bytes.size() >= magic.size() &&
               std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
    };
    if (type == "hdr") return starts("#?");
    if (type == "jpeg") return starts("\xff\xd8\xff");
    return starts("P5") || starts("P6");
}

}  // namespace

std::optional<std::size_t> lead_in_size(std::string_view type, Bytes bytes) {
    if (type == "hdr") return hdr_size(bytes);
    if (type == "jpeg") return jpeg_size(bytes);
    if (type == "pnm") return pnm_size(bytes);
    throw std::invalid_argument(fmt::format("no lead-in is known of image type '{}'", type));
}

std::vector<std::byte> read_lead_in(std::string_view type, const std::filesystem::path& file) {
    const auto fail = [&](std::string_view why) {
        throw std::runtime_error(fmt::format("cannot read '{}': {}", file.string(), why));
    };
    std::ifstream stream(file, std::ios::binary);
    if (!stream) fail(std::strerror(errno));
    std::vector<std::byte> bytes(most);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(stream.gcount()));
    const auto size = lead_in_size(type, bytes);
    if (!size || !begins_as(type, bytes)) fail(fmt::format("no complete {} header", type));
    bytes.resize(size.value_or(0));
    return bytes;
}

LeadInFilter::LeadInFilter(std::string_view type, std::vector<std::byte> lead_in, Sink sink)
    : type_(type), lead_in_(std::move(lead_in)), sink_(std::move(sink)) {}

void LeadInFilter::write(Bytes bytes) {
    if (complete_) {
        sink_(bytes);
        return;
    }
    if (start_.size() > most) return;  // it never becomes complete, which the caller checks
    start_.insert(start_.end(), bytes.begin(), bytes.end());
    const auto size = lead_in_size(type_, start_);
    if (!size) return;
    complete_ = true;
    sink_(lead_in_);
    sink_(Bytes(start_).subspan(*size));
    start_ = {};
}

}  // namespace mpipov
