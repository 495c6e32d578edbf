#include "oiio_images.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <string_view>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

Depth depth_of(const OIIO::ImageSpec& spec, const fs::path& file) {
    for (const Depth depth : {Depth::uint8, Depth::uint16, Depth::half, Depth::float32}) {
        const std::string_view name = to_string(depth);
        if (spec.format == OIIO::TypeDesc(OIIO::string_view(name.data(), name.size())))
            return depth;
    }
    cannot_read(
        file, fmt::format("pixels of type {}, which POV-Ray does not write", spec.format.c_str()));
}

class OiioRows : public RowSource {
  public:
    explicit OiioRows(const fs::path& path) : RowSource(path) {
        // By the extension alone: left to itself, OpenImageIO tries a damaged file on each of its
        // thirty readers.
        input_ = OIIO::ImageInput::create(path.string(), false);
        if (!input_) cannot_read(path, OIIO::geterror());
        OIIO::ImageSpec hints, spec;
        hints.attribute("oiio:UnassociatedAlpha", 1);
        if (!input_->open(path.string(), spec, hints)) cannot_read(path, input_->geterror());
        if (spec.tile_width != 0 || spec.depth > 1 || !spec.channelformats.empty())
            cannot_read(path, "a kind of image that POV-Ray does not write");
        // How many cores a rank may use is not for this library to decide.
        input_->threads(1);
        layout_ = {.width = spec.width,
                   .height = spec.height,
                   .channels = spec.nchannels,
                   .depth = depth_of(spec, path)};
    }

    void read(int y0, int y1, std::span<std::byte> out) override {
        if (!input_->read_native_scanlines(0, 0, y0, y1, 0, out.data()))
            cannot_read(file(), fmt::format("truncated or damaged in rows {} to {} of {}: {}", y0,
                                            y1 - 1, layout_.height, input_->geterror()));
    }

  private:
    std::unique_ptr<OIIO::ImageInput> input_;
};

}  // namespace

std::unique_ptr<RowSource> open_oiio_rows(const std::filesystem::path& file) {
    return std::make_unique<OiioRows>(file);
}

}  // namespace mpipov
