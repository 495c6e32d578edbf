#include "cache_stream.h"

#include "failure.h"
#include "message.h"
#include "radiosity_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <stdexcept>

namespace mpipov {

std::optional<std::vector<std::byte>> next_piece(std::string_view text, std::size_t& offset) {
    const std::string_view piece = text.substr(std::min(offset, text.size()), max_band_bytes);
    if (piece.empty()) return {};
    offset += piece.size();
    std::vector<std::byte> bytes(piece.size());
    std::memcpy(bytes.data(), piece.data(), piece.size());
    return bytes;
}

void ReceivedCache::begin(const std::filesystem::path& file, std::size_t bytes) {
    file_.clear();
    out_ = {};
    announced_ = bytes;
    received_ = 0;
    if (bytes == 0) return;
    file_ = file;
    out_.open(file, std::ios::binary | std::ios::trunc);
    if (!out_)
        throw Failure(Exit::file,
                      fmt::format("cannot write '{}': {}", file.string(), std::strerror(errno)));
}

void ReceivedCache::take(const std::vector<std::byte>& piece) {
    if (piece.size() > announced_ - received_)
        throw std::runtime_error("more of a radiosity cache was sent than was announced");
    out_.write(reinterpret_cast<const char*>(piece.data()),
               static_cast<std::streamsize>(piece.size()));
    received_ += piece.size();
    if (complete()) out_.close();
    if (!out_)
        throw Failure(Exit::file,
                      fmt::format("cannot write '{}': {}", file_.string(), std::strerror(errno)));
}

std::string read_new_samples(const std::filesystem::path& file, std::size_t known,
                             long long calculated) {
    const auto failure = [&](const std::string& what) -> Failure {
        return {Exit::file,
                fmt::format("{} in '{}': is there space left?", what, file.parent_path().string())};
    };
    std::string text;
    if (known > 0 || std::filesystem::exists(file)) {
        std::ifstream in(file, std::ios::binary);
        in.seekg(0, std::ios::end);
        const auto end = static_cast<std::streamoff>(in.tellg());
        if (!in || end < static_cast<std::streamoff>(known))
            throw failure("a radiosity cache is shorter than it was");
        if (static_cast<std::size_t>(end) - known > max_samples_bytes)
            throw Failure(Exit::scene,
                          fmt::format("POV-Ray wrote {} bytes of radiosity samples, and {} are "
                                      "taken of a launch at most",
                                      static_cast<std::size_t>(end) - known, max_samples_bytes));
        in.seekg(static_cast<std::streamoff>(known));
        text.resize(static_cast<std::size_t>(end) - known);
        if (!in.read(text.data(), static_cast<std::streamsize>(text.size())))
            throw failure("cannot read a radiosity cache");
    }
    long long saved = 0;
    try {
        saved = static_cast<long long>(samples_of(text).size());
    } catch (const std::runtime_error& error) {
        throw failure(error.what());
    }
    // POV-Ray counts a few that it does not save: up to 2 in a thousand in four scenes.
    if (saved < calculated - 16 - calculated / 50)
        throw failure(fmt::format("POV-Ray saved {} of {} radiosity samples", saved, calculated));
    return text;
}

}  // namespace mpipov
