#include "image_file.h"

#include "image_library.h"
#include "row_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string_view>
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

}  // namespace

void cannot_read(const fs::path& file, std::string_view why) {
    throw std::runtime_error(fmt::format("cannot read '{}': {}", file.string(), why));
}

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

namespace {

std::unique_ptr<RowSource> open_rows(const fs::path& file) {
    constexpr std::string_view png_signature = "\x89PNG";
    std::array<char, 4> magic{};
    {
        std::ifstream stream(file, std::ios::binary);
        if (!stream) cannot_read(file, std::strerror(errno));
        stream.read(magic.data(), magic.size());
        if (stream.gcount() == 0) cannot_read(file, "the file is empty");
    }
    const std::string_view start(magic.data(), magic.size());
    if (start.starts_with("P5") || start.starts_with("P6")) return open_pnm_rows(file);
    if (start == png_signature) return open_png_rows(file);
    return image_library().open_rows(file);
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
        cannot_read(file, fmt::format("{}x{} pixels where {}x{} are expected", found.width,
                                      found.height, width, height));
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
