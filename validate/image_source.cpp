#include "image_source.h"

#include "failure.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string_view>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using OIIO::TypeDesc;

// The first line says it: OpenImageIO adds one for each of its layers.
[[noreturn]] void cannot_read(const fs::path& file, const std::string& why) {
    const std::string line = why.substr(0, why.find('\n'));
    throw Failure(Exit::file, fmt::format("cannot read '{}': {}", file.string(),
                                          line.empty() ? "it is damaged, or ends early" : line));
}

// libpng prints its errors before OpenImageIO 2.4 tells them to us. This is the C library's stream
// alone: what is written to the descriptor itself (sanitizers) still appears.
class SilentStderr {
  public:
    SilentStderr() : silent_(std::fopen("/dev/null", "w")) {
        if (silent_ != nullptr) stderr = silent_;
    }
    ~SilentStderr() {
        stderr = loud_;
        // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): this class is what owns it
        if (silent_ != nullptr) std::fclose(silent_);
    }
    SilentStderr(const SilentStderr&) = delete;
    SilentStderr& operator=(const SilentStderr&) = delete;

  private:
    std::FILE* loud_ = stderr;
    std::FILE* silent_;
};

TypeDesc raw_type_of(const ImageFormat& format) {
    if (format.depth == "uint8") return TypeDesc::UINT8;
    if (format.depth == "uint16") return TypeDesc::UINT16;
    if (format.depth == "double") return TypeDesc::DOUBLE;
    return TypeDesc::FLOAT;
}

ImageFormat format_of(const OIIO::ImageSpec& spec, const std::string& type, const fs::path& file) {
    ImageFormat format;
    format.width = spec.width;
    format.height = spec.height;
    format.channels = spec.channelnames;
    format.alpha = spec.alpha_channel;
    format.type = type;
    format.depth = spec.format.c_str();
    static constexpr std::array<std::string_view, 5> supported{"uint8", "uint16", "half", "float",
                                                               "double"};
    const bool known =
        std::find(supported.begin(), supported.end(), format.depth) != supported.end();
    if (!known)
        cannot_read(file, fmt::format("depth {} is not supported (convert with oiiotool -d uint16 "
                                      "or -d float)",
                                      format.depth));
    for (const TypeDesc& channel : spec.channelformats)
        if (channel != spec.format)
            cannot_read(file, "its channels differ in depth (convert with oiiotool -d float)");
    if (spec.tile_width != 0 || spec.depth > 1 || spec.deep)
        cannot_read(file,
                    "tiled, volume and deep images are not supported (convert with oiiotool "
                    "--scanline)");
    return format;
}

template <typename T>
void widen(const std::vector<std::byte>& raw, std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        T value;
        std::memcpy(&value, raw.data() + i * sizeof(T), sizeof(T));
        values[i] = static_cast<double>(value);
    }
}

}  // namespace

double ImageFormat::full_scale() const {
    if (depth == "uint8") return 255;
    return depth == "uint16" ? 65535 : 1;
}

std::string ImageFormat::raw_type() const {
    if (depth == "uint8") return "u1";
    if (depth == "uint16") return "u2";
    return depth == "double" ? "f8" : "f4";
}

std::span<const double> ImageBand::row(int r) const {
    const std::size_t length = values.size() / static_cast<std::size_t>(rows);
    return std::span(values).subspan(static_cast<std::size_t>(r) * length, length);
}

struct ImageSource::Input {
    OIIO::ImageInput::unique_ptr file;
};

ImageSource::ImageSource(const fs::path& file) : file_(file), input_(std::make_unique<Input>()) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status)) cannot_read(file, "no such file");
    if (fs::is_directory(status)) cannot_read(file, "it is a folder");
    const SilentStderr silent;
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    input_->file = OIIO::ImageInput::open(file.string(), &config);
    if (!input_->file) cannot_read(file, OIIO::geterror());
    format_ = format_of(input_->file->spec(), input_->file->format_name(), file);
}

ImageSource::~ImageSource() = default;
ImageSource::ImageSource(ImageSource&&) noexcept = default;
ImageSource& ImageSource::operator=(ImageSource&&) noexcept = default;

bool ImageSource::next_band(int rows, ImageBand& band) {
    rows = std::min(rows, format_.height - next_row_);
    if (rows <= 0) return false;
    const TypeDesc type = raw_type_of(format_);
    const std::size_t samples = static_cast<std::size_t>(rows) *
                                static_cast<std::size_t>(format_.width) * format_.channels.size();
    band.y = next_row_;
    band.rows = rows;
    band.raw.resize(samples * type.size());
    band.values.resize(samples);
    const int first = input_->file->spec().y + next_row_;
    const SilentStderr silent;
    if (!input_->file->read_scanlines(0, 0, first, first + rows, 0, 0, format_.channel_count(),
                                      type, band.raw.data()))
        cannot_read(file_, input_->file->geterror());
    if (type == TypeDesc::UINT8)
        widen<std::uint8_t>(band.raw, band.values);
    else if (type == TypeDesc::UINT16)
        widen<std::uint16_t>(band.raw, band.values);
    else if (type == TypeDesc::DOUBLE)
        widen<double>(band.raw, band.values);
    else
        widen<float>(band.raw, band.values);
    next_row_ += rows;
    return true;
}

namespace {

void write_whole(const fs::path& file, const OIIO::ImageSpec& spec, const void* pixels) {
    const auto fail = [&](const std::string& why) {
        throw Failure(Exit::file, fmt::format("cannot write '{}': {}", file.string(), why));
    };
    // OpenImageIO takes the type from the extension, so the temporary name keeps it.
    const fs::path part = file.parent_path() / fmt::format(".part-{}", file.filename().string());
    std::error_code error;
    {
        auto output = OIIO::ImageOutput::create(part.string());
        if (!output) fail(OIIO::geterror());
        const bool written = output->open(part.string(), spec) &&
                             output->write_image(spec.format, pixels) && output->close();
        if (!written) {
            const std::string why = output->geterror();
            output.reset();
            fs::remove(part, error);
            fail(why);
        }
    }
    fs::rename(part, file, error);
    if (error) fail(error.message());
}

}  // namespace

void write_gray_image(const fs::path& file, int width, int height, std::span<const float> values) {
    write_whole(file, OIIO::ImageSpec(width, height, 1, TypeDesc::FLOAT), values.data());
}

void write_colour_image(const fs::path& file, int width, int height,
                        std::span<const std::uint16_t> values) {
    OIIO::ImageSpec spec(width, height, 3, TypeDesc::UINT16);
    spec.attribute("oiio:ColorSpace", "sRGB");
    write_whole(file, spec, values.data());
}

}  // namespace mpipov
