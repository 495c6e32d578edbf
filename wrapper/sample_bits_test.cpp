#include "image_test_support.h"
#include "stitch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace mpipov {
namespace {

// NaNs of all kinds with what they carry, infinities, denormals, zeros of both signs: from the file
// that a section is read out of, over the canvas, to the image.
template <typename Bits>
void expect_bits_kept(Depth depth, const std::vector<Bits>& special) {
    const ScratchFolder folder("bits");
    const PixelLayout layout{.width = 37, .height = 21, .channels = 4, .depth = depth};
    std::vector<Bits> values(static_cast<std::size_t>(layout.width) * layout.height * 4);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<Bits>(special[i * 5 % special.size()]);
    const auto bytes = std::as_bytes(std::span(values));
    Canvas whole(layout);
    whole.place(whole.bounds(), bytes, whole.bounds());
    write_pattern(folder.path() / "sample.exr", layout, "openexr");
    FileStyle style;
    style.type = "openexr";
    style.extension = ".exr";
    style.sample = folder.path() / "sample.exr";
    write_image(whole, style, folder.path() / "frame.exr");

    Canvas stitched(layout);
    for (const Rect& section : {Rect{0, 0, 13, 21}, Rect{13, 0, 37, 8}, Rect{13, 8, 37, 21}}) {
        SectionReader reader(folder.path() / "frame.exr", layout.width, layout.height, section);
        while (const auto band = reader.next()) {
            stitched.place(band->rect, band->pixels, section);
            EXPECT_EQ(differing_pixels(whole, band->rect, band->pixels, section).pixels, 0);
        }
    }
    write_image(stitched, style, folder.path() / "stitched.exr");
    const Decoded image = decode(folder.path() / "stitched.exr");
    ASSERT_EQ(image.pixels.size(), bytes.size());
    EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(), image.pixels.begin()));
}

TEST(SampleBits, OfFloatsAreKept) {
    expect_bits_kept<std::uint32_t>(
        Depth::float32, {0x7fc00000, 0xffc12345, 0x7f800001, 0xffbfffff, 0x7f800000, 0xff800000,
                         0x00000001, 0x807fffff, 0x80000000, 0x00000000, 0x7f7fffff, 0x3f800000});
}

TEST(SampleBits, OfHalvesAreKept) {
    expect_bits_kept<std::uint16_t>(Depth::half, {0x7e00, 0xfe42, 0x7c01, 0xfdff, 0x7c00, 0xfc00,
                                                  0x0001, 0x83ff, 0x8000, 0x0000, 0x7bff, 0x3c00});
}

// More bytes than 2^35: nothing but address space is taken, but for the pages that are written.
TEST(LargeCanvas, PlacesAndReadsItsLastPixels) {
    const int side = 65536;
    Canvas canvas({.width = side, .height = side, .channels = 4, .depth = Depth::float32});
    const Rect corner{side - 2, side - 2, side, side};
    std::vector<std::byte> pixels(4 * canvas.layout().bytes_per_pixel());
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::byte>(i);
    canvas.place(corner, pixels, canvas.bounds());
    EXPECT_EQ(canvas.read(corner), pixels);
    EXPECT_EQ(canvas.rows(side - 1, side).size(), std::size_t{side} * 16);
    EXPECT_EQ(differing_pixels(canvas, corner, pixels, corner).pixels, 0);
}

}  // namespace
}  // namespace mpipov
