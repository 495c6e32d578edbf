// The section files that every rank reads: PNG and PNM, and the chunks of a PNG.
#include "entry.h"
#include "image_file.h"
#include "png_chunks.h"
#include "row_source.h"
#include "scratch_files.h"

#include <algorithm>
#include <stdexcept>

namespace {

using namespace mpipov;
using fuzz::require;
namespace fs = std::filesystem;

// A header may claim any size: a section is only read of a frame that has the job's.
constexpr long long most_pixels = 1 << 20;

bool is_read_by_us(std::string_view text) {
    return text.starts_with("\x89PNG") || text.starts_with("P5") || text.starts_with("P6");
}

std::vector<std::byte> read_section(const fs::path& file, const PixelLayout& frame,
                                    const Rect& section, std::size_t max_bytes) {
    SectionReader reader(file, frame.width, frame.height, section, max_bytes);
    std::vector<std::byte> pixels;
    while (const auto band = reader.next())
        pixels.insert(pixels.end(), band->pixels.begin(), band->pixels.end());
    require(pixels.size() == static_cast<std::size_t>(section.area()) * frame.bytes_per_pixel(),
            "all pixels are read");
    return pixels;
}

void check_pixels(const fs::path& file) {
    const PixelLayout frame = read_layout(file);
    require(frame.width > 0 && frame.height > 0 && frame.channels >= 1 && frame.channels <= 4,
            "a layout is one of an image");
    if (static_cast<long long>(frame.width) * frame.height > most_pixels) return;
    const Rect whole{0, 0, frame.width, frame.height};
    const Rect corner{frame.width / 2, frame.height / 2, frame.width, frame.height};
    const auto at_once = read_section(file, frame, whole, SectionReader::default_max_bytes);
    require(read_section(file, frame, whole, 1) == at_once, "bands of any size are the same");
    const auto part = read_section(file, frame, corner, 1000);
    const std::size_t row = static_cast<std::size_t>(corner.width()) * frame.bytes_per_pixel();
    require(std::equal(part.end() - static_cast<std::ptrdiff_t>(row), part.end(),
                       at_once.end() - static_cast<std::ptrdiff_t>(row)),
            "a section is cut out of the frame");
}

std::vector<std::byte> filtered(std::string_view png, const std::vector<PngChunk>& metadata,
                                std::size_t piece, bool& complete) {
    std::vector<std::byte> out;
    PngMetadataFilter filter(metadata, [&](std::span<const std::byte> bytes) {
        out.insert(out.end(), bytes.begin(), bytes.end());
    });
    const std::span bytes(reinterpret_cast<const std::byte*>(png.data()), png.size());
    for (std::size_t at = 0; at < bytes.size(); at += piece)
        filter.write(bytes.subspan(at, std::min(piece, bytes.size() - at)));
    complete = filter.complete();
    return out;
}

void check_chunks(const fs::path& file, std::string_view png) {
    const std::vector<PngChunk> metadata = read_png_metadata(file);
    std::size_t size = 0;
    for (const PngChunk& chunk : metadata) size += chunk.bytes.size();
    require(size <= png.size(), "chunks are no longer than the file");
    bool complete = false, also = false;
    const auto at_once = filtered(png, metadata, png.size(), complete);
    require(complete, "a file with an IEND chunk is complete");
    require(filtered(png, metadata, 7, also) == at_once && also, "pieces of any size are the same");
}

template <class Check>
void unless_damaged(const Check& check) {
    try {
        check();
    } catch (const std::runtime_error& error) {
        require(std::string_view(error.what()).find("input") != std::string_view::npos,
                "an error names the file");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::ScratchFiles scratch;
    const std::string_view text = fuzz::as_text(data, size);
    // All others are OpenImageIO's to read.
    if (!is_read_by_us(text)) return 0;
    const fs::path file = scratch.write("input", text);
    unless_damaged([&] { check_pixels(file); });
    unless_damaged([&] { check_chunks(file, text); });
    // Of something that is no PNG any bytes pass, and nothing overflows.
    bool complete = false;
    filtered(text, {}, 3, complete);
    return 0;
}
