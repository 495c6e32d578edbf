#include "fingerprint.h"

#include "journal.h"
#include "sha1_digits.h"

#include <OpenImageIO/hash.h>
#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <system_error>
#include <vector>

namespace mpipov {
namespace {

constexpr std::uintmax_t most_read_bytes = std::uintmax_t{1} << 30;
constexpr std::uintmax_t piece_bytes = std::uintmax_t{1} << 20;
constexpr int pieces = 64;
constexpr const char* mark = " bytes, pieces ";

std::string sha1_of_pieces(const std::filesystem::path& file, std::uintmax_t bytes) {
    OIIO::SHA1 sha;
    std::ifstream in(file, std::ios::binary);
    std::vector<char> piece(piece_bytes);
    for (int i = 0; i < pieces; ++i) {
        in.seekg(static_cast<std::streamoff>(
            (bytes - piece_bytes) / (pieces - 1) * i +
            (i == pieces - 1 ? (bytes - piece_bytes) % (pieces - 1) : 0)));
        if (!in.read(piece.data(), static_cast<std::streamsize>(piece.size()))) return {};
        sha.append(piece.data(), piece.size());
    }
    return sha1_digits(sha);
}

}  // namespace

std::string fingerprint(const std::filesystem::path& file) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(file, error);
    if (error || bytes <= most_read_bytes) return sha1_of_file(file);
    const std::string sha1 = sha1_of_pieces(file, bytes);
    return sha1.empty() ? sha1 : fmt::format("{}{}{}", bytes, mark, sha1);
}

bool is_of_whole_file(const std::string& fingerprint) {
    return !fingerprint.empty() && fingerprint.find(mark) == std::string::npos;
}

}  // namespace mpipov
