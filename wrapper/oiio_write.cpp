// From the canvas to the image file.
#include "lead_in.h"
#include "oiio_images.h"
#include "png_chunks.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using Bytes = std::span<const std::byte>;

// The file that OpenImageIO writes to. Its writers do not all notice a failed write, and none can
// say whether the last buffers reached the disk: this one keeps the first error.
class OutputFile : public OIIO::Filesystem::IOProxy {
  public:
    explicit OutputFile(const fs::path& path)
        : IOProxy(path.string(), Write), file_(std::fopen(path.c_str(), "w+b"), &std::fclose) {
        if (!file_) note_error();
    }

    const char* proxytype() const override { return "mpipov"; }

    bool seek(std::int64_t offset) override {
        if (!file_) return false;
        if (::fseeko(file_.get(), offset, SEEK_SET) != 0) return note_error();
        m_pos = offset;
        return true;
    }

    std::size_t write(const void* bytes, std::size_t size) override {
        if (!file_ || size == 0) return 0;
        const std::size_t written = std::fwrite(bytes, 1, size, file_.get());
        if (written != size) note_error();
        m_pos += static_cast<std::int64_t>(written);
        size_ = std::max(size_, m_pos);
        return written;
    }

    std::size_t read(void* bytes, std::size_t size) override {
        return file_ ? std::fread(bytes, 1, size, file_.get()) : 0;
    }

    std::size_t size() const override { return static_cast<std::size_t>(size_); }

    // Network file systems, and those that allocate late, report a full disk only here.
    void finish() {
        if (!file_) return;
        if (std::fflush(file_.get()) != 0) note_error();
        // Pipes and devices cannot be synchronised, nor need they be.
        if (::fsync(::fileno(file_.get())) != 0 && errno != EINVAL && errno != ENOTSUP)
            note_error();
        if (std::fclose(file_.release()) != 0) note_error();
    }

    // errno of what failed first, 0 where nothing did.
    int first_error() const { return first_error_; }

  private:
    bool note_error() {
        if (first_error_ == 0) first_error_ = errno != 0 ? errno : EIO;
        return false;
    }

    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
    std::int64_t size_ = 0;
    int first_error_ = 0;
};

// What OpenImageIO writes passes through a filter on its way to the file. For writers that never
// seek: PNG, JPEG and HDR.
class FilteredOutput : public OIIO::Filesystem::IOProxy {
  public:
    FilteredOutput(const OutputFile& file, std::function<void(Bytes)> filter)
        : IOProxy(file.filename(), Write), filter_(std::move(filter)) {}

    const char* proxytype() const override { return "mpipov"; }
    bool seek(std::int64_t offset) override { return offset == m_pos; }

    std::size_t write(const void* bytes, std::size_t size) override {
        filter_({static_cast<const std::byte*>(bytes), size});
        m_pos += static_cast<std::int64_t>(size);
        return size;
    }

  private:
    std::function<void(Bytes)> filter_;
};

// The sample's own description, with the canvas's size.
OIIO::ImageSpec spec_of(const Canvas& canvas, const FileStyle& style) {
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open(style.sample.string(), &hints);
    if (!input)
        throw std::runtime_error(
            fmt::format("cannot read '{}': {}", style.sample.string(), OIIO::geterror()));
    const PixelLayout& layout = canvas.layout();
    OIIO::ImageSpec spec = input->spec();
    const OIIO::string_view depth(to_string(layout.depth).data(), to_string(layout.depth).size());
    if (style.type != input->format_name() || spec.nchannels != layout.channels ||
        spec.format != OIIO::TypeDesc(depth))
        throw std::runtime_error(fmt::format(
            "a canvas of {} channels of {} cannot be written as {} like '{}', which is {} with {} "
            "channels of {}",
            layout.channels, to_string(layout.depth), style.type, style.sample.string(),
            input->format_name(), spec.nchannels, spec.format.c_str()));
    spec.width = spec.full_width = layout.width;
    spec.height = spec.full_height = layout.height;
    // The canvas holds what belongs into the file: nothing is to be divided by alpha.
    spec.attribute("oiio:UnassociatedAlpha", 1);
    if (style.type == "jpeg") {
        if (style.jpeg_quality < 1 || style.jpeg_quality > 100)
            throw std::runtime_error(
                fmt::format("JPEG quality {} is not between 1 and 100", style.jpeg_quality));
        spec.attribute("Compression", fmt::format("jpeg:{}", style.jpeg_quality));
        spec.attribute("jpeg:subsampling", "4:4:4");
    }
    if (style.type == "targa") spec.attribute("compression", style.rle ? "rle" : "none");
    return spec;
}

// Of the canvas, so many rows at a time: a multiple of the 16 that EXR compresses together.
template <typename Write>
void for_each_band(const Canvas& canvas, Write write) {
    constexpr int band = 16;
    const int height = canvas.layout().height;
    for (int y = 0; y < height; y += band) write(y, std::min(y + band, height));
}

// OpenImageIO 2.4 writes PNM with 8 bits only.
void write_pnm(const Canvas& canvas, const FileStyle& style, OutputFile& file) {
    const PixelLayout& layout = canvas.layout();
    const bool wide = layout.depth == Depth::uint16;
    const auto lead_in = read_lead_in("pnm", style.sample);
    file.write(lead_in.data(), lead_in.size());
    const std::string sizes =
        fmt::format("{} {}\n{}\n", layout.width, layout.height, wide ? 65535 : 255);
    file.write(sizes.data(), sizes.size());
    std::vector<std::byte> swapped;
    for_each_band(canvas, [&](int y0, int y1) {
        Bytes rows = canvas.rows(y0, y1);
        if (wide) {  // the high byte comes first
            swapped.assign(rows.begin(), rows.end());
            for (std::size_t i = 0; i + 1 < swapped.size(); i += 2)
                std::swap(swapped[i], swapped[i + 1]);
            rows = swapped;
        }
        file.write(rows.data(), rows.size());
    });
}

void write_rows(const Canvas& canvas, const FileStyle& style, const OIIO::ImageSpec& spec,
                OIIO::Filesystem::IOProxy& target, const OutputFile& file) {
    const auto output = OIIO::ImageOutput::create(style.type);
    if (!output) throw std::runtime_error(OIIO::geterror());
    const auto require = [&](bool ok) {
        if (!ok || file.first_error() != 0) throw std::runtime_error(output->geterror());
    };
    require(output->set_ioproxy(&target) && output->open(file.filename(), spec));
    for_each_band(canvas, [&](int y0, int y1) {
        require(output->write_scanlines(y0, y1, 0, spec.format, canvas.rows(y0, y1).data()));
    });
    require(output->close());
}

// TGA 2.0: a footer of 26 bytes that begins with the extension area's offset, four bytes with the
// low one first. The area, 495 bytes, holds the date, program, comments, gamma and kind of alpha.
constexpr std::size_t tga_footer_size = 26, tga_extension_size = 495;

std::optional<std::int64_t> tga_extension(std::span<const std::byte, tga_footer_size> footer) {
    constexpr std::string_view signature = "TRUEVISION-XFILE.";
    if (std::memcmp(footer.data() + 8, signature.data(), signature.size()) != 0)
        return std::nullopt;
    std::int64_t offset = 0;
    for (std::size_t i = 4; i-- > 0;) offset = offset << 8 | std::to_integer<int>(footer[i]);
    return offset == 0 ? std::nullopt : std::optional(offset);
}

// OpenImageIO garbles the program's version and leaves out what it does not know.
void copy_tga_extension(const fs::path& sample, OutputFile& file) {
    std::array<std::byte, tga_footer_size> from{}, to{};
    std::array<std::byte, tga_extension_size> extension{};
    const auto chars = [](auto& bytes) { return reinterpret_cast<char*>(bytes.data()); };
    std::ifstream stream(sample, std::ios::binary);
    stream.seekg(-static_cast<std::streamoff>(from.size()), std::ios::end);
    stream.read(chars(from), from.size());
    const auto source = tga_extension(from);
    if (!stream || !source) return;  // the sample has none
    stream.seekg(*source);
    stream.read(chars(extension), extension.size());
    file.seek(static_cast<std::int64_t>(file.size() - to.size()));
    file.read(to.data(), to.size());
    const auto target = tga_extension(to);
    if (!stream || !target) throw std::runtime_error("no TGA extension area");
    file.seek(*target);
    file.write(extension.data(), extension.size());
}

void encode(const Canvas& canvas, const FileStyle& style, OutputFile& file) {
    const OIIO::ImageSpec spec = spec_of(canvas, style);
    const auto sink = [&file](Bytes bytes) { file.write(bytes.data(), bytes.size()); };
    if (style.type == "pnm") {
        write_pnm(canvas, style, file);
    } else if (style.type == "png") {
        PngMetadataFilter filter(read_png_metadata(style.sample), sink);
        FilteredOutput target(file, [&](Bytes bytes) { filter.write(bytes); });
        write_rows(canvas, style, spec, target, file);
        if (!filter.complete()) throw std::runtime_error("the encoder left the PNG incomplete");
    } else if (style.type == "jpeg" || style.type == "hdr") {
        LeadInFilter filter(style.type, read_lead_in(style.type, style.sample), sink);
        FilteredOutput target(file, [&](Bytes bytes) { filter.write(bytes); });
        write_rows(canvas, style, spec, target, file);
        if (!filter.complete()) throw std::runtime_error("the encoder left the header incomplete");
    } else {
        write_rows(canvas, style, spec, file, file);
        if (style.type == "targa") copy_tga_extension(style.sample, file);
    }
}

}  // namespace

void write_by_oiio(const Canvas& canvas, const FileStyle& style, const fs::path& file) {
    OutputFile output(file);
    std::string why;
    if (output.first_error() == 0) {
        try {
            encode(canvas, style, output);
        } catch (const std::exception& error) {
            why = error.what();
        }
        output.finish();
    }
    if (output.first_error() != 0) why = std::strerror(output.first_error());
    if (why.empty()) return;
    // Half a file helps nobody, least of all on a full disk. Never remove a device.
    std::error_code ignored;
    if (fs::is_regular_file(file, ignored)) fs::remove(file, ignored);
    throw std::runtime_error(fmt::format("cannot write '{}': {}", file.string(), why));
}

}  // namespace mpipov
