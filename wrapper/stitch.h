// The canvas that sections are put together on, and the image file that is made of it.
#pragma once

#include "image_file.h"
#include "section.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace mpipov {

// The whole frame, W x H x C, zero at the start. Pages are taken as pixels are placed: a canvas of
// which nothing has been written costs address space only.
class Canvas {
  public:
    // Throws std::invalid_argument for an empty layout, std::runtime_error when there is no memory.
    explicit Canvas(const PixelLayout& layout);

    const PixelLayout& layout() const { return layout_; }
    Rect bounds() const { return {0, 0, layout_.width, layout_.height}; }

    // `pixels` holds `rect`, row by row; what lies inside `keep` is copied. Throws
    // std::invalid_argument when rect does not lie in the frame or pixels is not of its size.
    void place(const Rect& rect, std::span<const std::byte> pixels, const Rect& keep);

    // What POV-Ray leaves around a region that it was told to render: black, and opaque where there
    // is an alpha channel (the last of 2 or 4), else as the canvas was.
    void make_opaque_outside(const Rect& region);

    // A copy of the pixels of `rect`, row by row. Throws std::invalid_argument as place does.
    std::vector<std::byte> read(const Rect& rect) const;

    // Whole rows y0..y1, in place. Throws std::invalid_argument for rows outside the frame.
    std::span<const std::byte> rows(int y0, int y1) const;

    // SHA-1 of all pixel bytes in row order, as sha1sum prints it: run.json's pixel_sha1.
    std::string sha1() const;

  private:
    void make_opaque(const Rect& rect);

    struct Unmap {
        std::size_t size;
        void operator()(std::byte* pixels) const;
    };

    PixelLayout layout_;
    std::unique_ptr<std::byte[], Unmap> pixels_;
};

struct Difference {
    long long pixels = 0;  // that differ in at least one channel, in at least one bit
    // Of one channel: levels of 8 or 16 bits, or values of a float image; infinite where one of the
    // two is no finite number.
    double largest = 0;
};

// Compares `pixels`, which holds `rect`, with the canvas, within `within`: the self-check where two
// sections rendered the same overlap. Throws std::invalid_argument as Canvas::place does.
Difference differing_pixels(const Canvas& canvas, const Rect& rect,
                            std::span<const std::byte> pixels, const Rect& within);

// How POV-Ray would have written the file.
struct FileStyle {
    std::string type;  // OpenImageIO's name: png, openexr, hdr, jpeg, targa, bmp, pnm
    std::string
        extension;         // of the final file, with its dot; the file written need not have it yet
    int jpeg_quality = 0;  // 1 to 100, with type jpeg: POV-Ray's Compression
    bool rle = false;      // with type targa: +FC
    std::filesystem::path sample;  // an image of any size that POV-Ray wrote with the same
                                   // settings: where channels, depth and metadata come from
};

// Encodes the canvas to `file`, in the type and with the metadata of the sample; pixels decode to
// the canvas's bits (JPEG: to what POV-Ray's own encoder makes of them). Overwrites `file`; on an
// error it is removed. Memory: a few MB beside the canvas, at 8000x8000
// 10 at most (EXR).
// Throws std::runtime_error "cannot write '<file>': ...", whatever the reason: a full disk, an
// unreadable sample, or one of other channels or depth than the canvas.
void write_image(const Canvas& canvas, const FileStyle& style, const std::filesystem::path& file);

}  // namespace mpipov
