#include "image_file.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<Depth, std::string_view>, 4> depth_names{{
    {Depth::uint8, "uint8"},
    {Depth::uint16, "uint16"},
    {Depth::half, "half"},
    {Depth::float32, "float"},
}};

[[noreturn]] void fail(const fs::path& file, std::string_view why) {
    throw std::runtime_error(fmt::format("cannot read '{}': {}", file.string(), why));
}

}  // namespace

std::string_view to_string(Depth depth) {
    for (const auto& [value, name] : depth_names)
        if (value == depth) return name;
    return "?";
}

Depth depth_from_string(std::string_view name) {
    for (const auto& [value, known] : depth_names)
        if (known == name) return value;
    throw std::invalid_argument(
        fmt::format("unknown pixel depth '{}': uint8, uint16, half or float", name));
}

std::size_t bytes_per_value(Depth depth) {
    switch (depth) {
        case Depth::uint8:
            return 1;
        case Depth::uint16:
        case Depth::half:
            return 2;
        case Depth::float32:
            return 4;
    }
    return 0;
}

// An image file, read row by row from the top.
class RowSource {
  public:
    explicit RowSource(fs::path file) : file_(std::move(file)) {}
    virtual ~RowSource() = default;
    RowSource(const RowSource&) = delete;
    RowSource& operator=(const RowSource&) = delete;

    const fs::path& file() const { return file_; }
    const PixelLayout& layout() const { return layout_; }

    // Rows y0..y1 of the frame into `out`, which holds just these.
    virtual void read(int y0, int y1, std::span<std::byte> out) = 0;

  protected:
    PixelLayout layout_;

  private:
    fs::path file_;
};

namespace {

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
            fail(file(),
                 fmt::format("a PNM file with the maximum {} and not 255 or 65535", largest));
        layout_.depth = largest == 255 ? Depth::uint8 : Depth::uint16;
        data_ = static_cast<std::uintmax_t>(stream_.tellg());
        const std::uintmax_t needed =
            data_ + layout_.row_bytes() * static_cast<std::uintmax_t>(layout_.height);
        const std::uintmax_t size = fs::file_size(path);
        if (size != needed)
            fail(file(), fmt::format("{} bytes where {}x{} pixels take {}: {}", size, layout_.width,
                                     layout_.height, needed,
                                     size < needed
                                         ? "truncated"
                                         : "POV-Ray 3.7 damages gray PGM files of 8 bits, ask for "
                                           "Bits_Per_Color=16 or for PNG"));
    }

    void read(int y0, int y1, std::span<std::byte> out) override {
        stream_.seekg(static_cast<std::streamoff>(data_ + layout_.row_bytes() *
                                                              static_cast<std::uintmax_t>(y0)));
        stream_.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(out.size()));
        if (!stream_)
            fail(file(),
                 fmt::format("rows {} to {} of {} cannot be read", y0, y1 - 1, layout_.height));
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
            fail(file(), "the PNM header is damaged");
        return value;
    }

    std::ifstream stream_;
    std::uintmax_t data_ = 0;  // where the pixels begin
};

Depth depth_of(const OIIO::ImageSpec& spec, const fs::path& file) {
    for (const auto& [value, name] : depth_names)
        if (spec.format == OIIO::TypeDesc(OIIO::string_view(name.data(), name.size())))
            return value;
    fail(file, fmt::format("pixels of type {}, which POV-Ray does not write", spec.format.c_str()));
}

class OiioRows : public RowSource {
  public:
    explicit OiioRows(const fs::path& path) : RowSource(path) {
        // By the extension alone: left to itself, OpenImageIO tries a damaged file on each of its
        // thirty readers.
        input_ = OIIO::ImageInput::create(path.string(), false);
        if (!input_) fail(path, OIIO::geterror());
        OIIO::ImageSpec hints, spec;
        hints.attribute("oiio:UnassociatedAlpha", 1);
        if (!input_->open(path.string(), spec, hints)) fail(path, input_->geterror());
        if (spec.tile_width != 0 || spec.depth > 1 || !spec.channelformats.empty())
            fail(path, "a kind of image that POV-Ray does not write");
        // How many cores a rank may use is not for this library to decide.
        input_->threads(1);
        layout_ = {.width = spec.width,
                   .height = spec.height,
                   .channels = spec.nchannels,
                   .depth = depth_of(spec, path)};
    }

    void read(int y0, int y1, std::span<std::byte> out) override {
        if (!input_->read_native_scanlines(0, 0, y0, y1, 0, out.data()))
            fail(file(), fmt::format("truncated or damaged in rows {} to {} of {}: {}", y0, y1 - 1,
                                     layout_.height, input_->geterror()));
    }

  private:
    std::unique_ptr<OIIO::ImageInput> input_;
};

std::unique_ptr<RowSource> open_rows(const fs::path& file) {
    std::array<char, 2> magic{};
    {
        std::ifstream stream(file, std::ios::binary);
        if (!stream) fail(file, std::strerror(errno));
        stream.read(magic.data(), magic.size());
        if (!stream) fail(file, "the file is empty");
    }
    if (magic[0] == 'P' && (magic[1] == '5' || magic[1] == '6'))
        return std::make_unique<PnmRows>(file);
    return std::make_unique<OiioRows>(file);
}

// EXR compresses sixteen rows at a time.
constexpr int rows_at_once = 16;

}  // namespace

PixelLayout read_layout(const fs::path& file) {
    return open_rows(file)->layout();
}

SectionReader::SectionReader(const fs::path& file, int width, int height, const Rect& section,
                             std::size_t max_bytes)
    : source_(open_rows(file)), section_(section), next_row_(section.y0), max_bytes_(max_bytes) {
    const PixelLayout& found = source_->layout();
    if (found.width != width || found.height != height)
        fail(file, fmt::format("{}x{} pixels where {}x{} are expected", found.width, found.height,
                               width, height));
    if (section.empty() || intersect(section, {0, 0, width, height}) != section)
        throw std::invalid_argument(
            fmt::format("section ({}, {}) to ({}, {}) does not lie within {}x{} pixels", section.x0,
                        section.y0, section.x1, section.y1, width, height));
}

SectionReader::~SectionReader() = default;
SectionReader::SectionReader(SectionReader&&) noexcept = default;
SectionReader& SectionReader::operator=(SectionReader&&) noexcept = default;

const PixelLayout& SectionReader::layout() const {
    return source_->layout();
}

std::optional<Band> SectionReader::next() {
    if (next_row_ >= section_.y1) return std::nullopt;
    const std::size_t pixel = layout().bytes_per_pixel();
    const std::size_t frame_row = layout().row_bytes();
    const std::size_t row = static_cast<std::size_t>(section_.width()) * pixel;
    const std::size_t offset = static_cast<std::size_t>(section_.x0) * pixel;

    Band band;
    const auto fitting = std::max<std::size_t>(1, max_bytes_ / row);
    const int left = section_.y1 - next_row_;
    const int height = fitting < static_cast<std::size_t>(left) ? static_cast<int>(fitting) : left;
    band.rect = {section_.x0, next_row_, section_.x1, next_row_ + height};
    band.pixels.resize(static_cast<std::size_t>(height) * row);

    auto out = band.pixels.begin();
    for (int y = band.rect.y0; y < band.rect.y1; y += rows_at_once) {
        const int end = std::min(y + rows_at_once, band.rect.y1);
        rows_.resize(static_cast<std::size_t>(end - y) * frame_row);
        source_->read(y, end, rows_);
        for (std::size_t at = offset; at < rows_.size(); at += frame_row)
            out = std::copy_n(rows_.begin() + static_cast<std::ptrdiff_t>(at), row, out);
    }
    next_row_ = band.rect.y1;
    return band;
}

}  // namespace mpipov
