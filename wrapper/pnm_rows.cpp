#include "row_source.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <fstream>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

// PGM and PPM, binary, as POV-Ray writes them. OpenImageIO 2.4 loads such a file as a whole, where
// a seek to the rows is enough, and decodes some values of 16 bits one level too low.
class PnmRows : public RowSource {
  public:
    explicit PnmRows(const fs::path& path) : RowSource(path), stream_(path, std::ios::binary) {
        std::array<char, 2> magic{};
        stream_.read(magic.data(), magic.size());
        layout_.channels = magic[1] == '6' ? 3 : 1;
        layout_.width = number();
        layout_.height = number();
        const int largest = number();
        if (largest != 255 && largest != 65535)
            cannot_read(file(), fmt::format("a PNM file with the maximum {} and not 255 or 65535",
                                            largest));
        layout_.depth = largest == 255 ? Depth::uint8 : Depth::uint16;
        data_ = static_cast<std::uintmax_t>(stream_.tellg());
        const std::uintmax_t needed =
            data_ + layout_.row_bytes() * static_cast<std::uintmax_t>(layout_.height);
        const std::uintmax_t size = fs::file_size(path);
        if (size != needed)
            cannot_read(
                file(),
                fmt::format("{} bytes where {}x{} pixels take {}: {}", size, layout_.width,
                            layout_.height, needed,
                            size < needed ? "truncated"
                                          : "POV-Ray 3.7 damages gray PGM files of 8 bits, ask for "
                                            "Bits_Per_Color=16 or for PNG"));
    }

    void read(int y0, int y1, std::span<std::byte> out) override {
        stream_.seekg(static_cast<std::streamoff>(data_ + layout_.row_bytes() *
                                                              static_cast<std::uintmax_t>(y0)));
        stream_.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(out.size()));
        if (!stream_)
            cannot_read(file(), fmt::format("rows {} to {} of {} cannot be read", y0, y1 - 1,
                                            layout_.height));
        if (layout_.depth == Depth::uint16 && std::endian::native == std::endian::little)
            for (std::size_t i = 0; i + 1 < out.size(); i += 2) std::swap(out[i], out[i + 1]);
    }

  private:
    // The header's next number, and the one byte of white space that ends it.
    int number() {
        int c = stream_.get();
        while (c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '#') {
            if (c == '#')
                while (c != '\n' && c != std::char_traits<char>::eof()) c = stream_.get();
            c = stream_.get();
        }
        int value = 0;
        for (; c >= '0' && c <= '9' && value < 10'000'000; c = stream_.get())
            value = value * 10 + (c - '0');
        if (value == 0 || (c != ' ' && c != '\n' && c != '\r' && c != '\t'))
            cannot_read(file(), "the PNM header is damaged");
        return value;
    }

    std::ifstream stream_;
    std::uintmax_t data_ = 0;  // where the pixels begin
};

}  // namespace

std::unique_ptr<RowSource> open_pnm_rows(const std::filesystem::path& file) {
    return std::make_unique<PnmRows>(file);
}

}  // namespace mpipov
