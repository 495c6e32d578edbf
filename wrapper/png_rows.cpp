#include "row_source.h"

#include <fmt/format.h>
#include <png.h>

#include <array>
#include <bit>
#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <string>

namespace mpipov {
namespace {

constexpr std::size_t longest_message = 128;

// libpng's way to report an error is a longjmp, which skips destructors: `step` must have none, nor
// anything that it calls. What libpng said is in the error pointer's buffer then.
template <typename Step>
bool without_error(png_structp png, const Step& step) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    step();
    return true;
}

void note_error(png_structp png, png_const_charp message) {
    std::snprintf(static_cast<char*>(png_get_error_ptr(png)), longest_message, "%s", message);
    std::longjmp(png_jmpbuf(png), 1);
}

void ignore_warning(png_structp, png_const_charp) {}

class PngRows : public RowSource {
  public:
    explicit PngRows(const std::filesystem::path& path)
        : RowSource(path), stream_(std::fopen(path.c_str(), "rb"), &std::fclose) {
        if (!stream_) cannot_read(path, std::strerror(errno));
        decoder_.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, message_.data(), &note_error,
                                              &ignore_warning);
        if (decoder_.png != nullptr) decoder_.info = png_create_info_struct(decoder_.png);
        if (decoder_.info == nullptr) cannot_read(path, "no memory for the PNG decoder");
        if (!without_error(decoder_.png, [this] { read_header(); }))
            cannot_read(path, message_.data());
        if (png_get_interlace_type(decoder_.png, decoder_.info) != PNG_INTERLACE_NONE)
            cannot_read(path, "an interlaced PNG, which POV-Ray does not write");
    }

    void read(int y0, int y1, std::span<std::byte> out) override {
        const bool good = without_error(decoder_.png, [&] {
            for (; next_row_ < y0; ++next_row_) png_read_row(decoder_.png, nullptr, nullptr);
            auto* row = reinterpret_cast<png_bytep>(out.data());
            for (; next_row_ < y1; ++next_row_, row += layout_.row_bytes())
                png_read_row(decoder_.png, row, nullptr);
            // The checksum over the last rows comes after them.
            if (next_row_ == layout_.height) png_read_end(decoder_.png, nullptr);
        });
        if (!good)
            cannot_read(file(), fmt::format("truncated or damaged in rows {} to {} of {}: {}", y0,
                                            y1 - 1, layout_.height, message_.data()));
    }

  private:
    struct Decoder {
        Decoder() = default;
        ~Decoder() { png_destroy_read_struct(&png, &info, nullptr); }
        Decoder(const Decoder&) = delete;
        Decoder& operator=(const Decoder&) = delete;
        png_structp png = nullptr;
        png_infop info = nullptr;
    };

    void read_header() {
        png_init_io(decoder_.png, stream_.get());
        png_read_info(decoder_.png, decoder_.info);
        png_set_expand(decoder_.png);  // to at least eight bits
        if constexpr (std::endian::native == std::endian::little) png_set_swap(decoder_.png);
        png_read_update_info(decoder_.png, decoder_.info);
        layout_ = {.width = static_cast<int>(png_get_image_width(decoder_.png, decoder_.info)),
                   .height = static_cast<int>(png_get_image_height(decoder_.png, decoder_.info)),
                   .channels = png_get_channels(decoder_.png, decoder_.info),
                   .depth = png_get_bit_depth(decoder_.png, decoder_.info) == 16 ? Depth::uint16
                                                                                 : Depth::uint8};
    }

    std::array<char, longest_message> message_{};
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream_;
    Decoder decoder_;
    int next_row_ = 0;
};

}  // namespace

std::unique_ptr<RowSource> open_png_rows(const std::filesystem::path& file) {
    return std::make_unique<PngRows>(file);
}

}  // namespace mpipov
