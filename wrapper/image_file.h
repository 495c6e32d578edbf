// Reading the image files that POV-Ray writes: their layout, and the pixels of one section.
// A launch with +SC +EC +SR +ER still writes a file of the whole frame, zero outside its section;
// SectionReader crops. Pixel values are handed on as they are stored, in the machine's byte order:
// no gamma, no multiplication by alpha, no change of type.
#pragma once

#include "section.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace mpipov {

enum class Depth { uint8, uint16, half, float32 };

// "uint8", "uint16", "half", "float": OpenImageIO's names, which run.json uses too.
std::string_view to_string(Depth depth);
// Throws std::invalid_argument.
Depth depth_from_string(std::string_view name);

std::size_t bytes_per_value(Depth depth);

// What a block of pixels is made of: rows from the top, channels interleaved, without padding.
struct PixelLayout {
    int width = 0, height = 0, channels = 0;
    Depth depth = Depth::uint8;

    std::size_t bytes_per_pixel() const {
        return static_cast<std::size_t>(channels) * bytes_per_value(depth);
    }
    std::size_t row_bytes() const { return static_cast<std::size_t>(width) * bytes_per_pixel(); }
    bool operator==(const PixelLayout&) const = default;
};

// Throws std::runtime_error naming the file, when it is missing, empty or no image.
PixelLayout read_layout(const std::filesystem::path& file);

// Whole rows of a section: rect.width() x rect.height() pixels.
struct Band {
    Rect rect;  // in the whole image
    std::vector<std::byte> pixels;
};

class RowSource;

// Memory: one band, sixteen rows of the frame, and what the decoder needs. Measured at 8000x8000:
// under 15 MB beside the band for PNG, PNM, BMP, HDR and EXR. OpenImageIO 2.4's TGA reader holds
// the whole frame (190 MB there): render sections for a TGA as PNG, whose pixels are the same.
class SectionReader {
  public:
    static constexpr std::size_t default_max_bytes = std::size_t{8} << 20;

    // `file` has to be a frame of width x height pixels, and `section` to lie within it. Throws
    // std::runtime_error naming the file and what is wrong with it (missing, empty, no image, other
    // size), std::invalid_argument for a section outside the frame.
    SectionReader(const std::filesystem::path& file, int width, int height, const Rect& section,
                  std::size_t max_bytes = default_max_bytes);
    ~SectionReader();
    SectionReader(SectionReader&&) noexcept;
    SectionReader& operator=(SectionReader&&) noexcept;

    // Of the frame, not of the section.
    const PixelLayout& layout() const;

    // The section's next rows, as many as fit into max_bytes but at least one; nothing after the
    // last. Throws std::runtime_error where the file is truncated or damaged.
    std::optional<Band> next();

  private:
    std::unique_ptr<RowSource> source_;
    Rect section_;
    int next_row_ = 0;
    std::size_t max_bytes_ = 0;
    std::vector<std::byte> rows_;  // whole rows of the frame, before cropping
};

}  // namespace mpipov
