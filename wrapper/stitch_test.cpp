#include "stitch.h"

#include "image_test_support.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

namespace mpipov {
namespace {

const PixelLayout small{.width = 5, .height = 4, .channels = 1, .depth = Depth::uint8};

std::string all_of(const Canvas& canvas) {
    return as_text(canvas.read(canvas.bounds()));
}

TEST(Canvas, IsZeroAtTheStart) {
    EXPECT_EQ(all_of(Canvas(small)), std::string(20, '\0'));
}

TEST(Canvas, TakesOnlyWhatIsToBeKept) {
    Canvas canvas(small);
    canvas.place(canvas.bounds(), as_bytes(std::string(20, '.')), canvas.bounds());
    canvas.place({1, 1, 4, 3}, as_bytes("abcdef"), {2, 0, 5, 2});
    EXPECT_EQ(all_of(canvas),
              "....."
              "..bc."
              "....."
              ".....");
    canvas.place({1, 1, 4, 3}, as_bytes("uvwxyz"), {4, 0, 5, 2});
    EXPECT_EQ(as_text(canvas.read({1, 1, 4, 3})), ".bc...");
    EXPECT_EQ(as_text(canvas.rows(1, 2)), "..bc.");
}

TEST(Canvas, PlacesPixelsOfSeveralBytes) {
    Canvas canvas({.width = 2, .height = 2, .channels = 2, .depth = Depth::uint16});
    canvas.place({1, 0, 2, 2}, as_bytes("abcdefgh"), canvas.bounds());
    EXPECT_EQ(all_of(canvas), std::string("\0\0\0\0abcd\0\0\0\0efgh", 16));
}

TEST(Canvas, RefusesWhatDoesNotFit) {
    Canvas canvas(small);
    const std::string pixels(20, 'x');
    EXPECT_THROW(canvas.place({0, 0, 5, 4}, as_bytes(pixels.substr(1)), canvas.bounds()),
                 std::invalid_argument);
    EXPECT_THROW(canvas.place({1, 0, 6, 4}, as_bytes(pixels), canvas.bounds()),
                 std::invalid_argument);
    EXPECT_THROW(canvas.place({-1, 0, 4, 4}, as_bytes(pixels), canvas.bounds()),
                 std::invalid_argument);
    EXPECT_THROW(canvas.read({0, 0, 5, 5}), std::invalid_argument);
    EXPECT_THROW(canvas.read({3, 3, 3, 4}), std::invalid_argument);
    EXPECT_THROW(canvas.rows(0, 5), std::invalid_argument);
    EXPECT_THROW(Canvas({.width = 0, .height = 4, .channels = 1, .depth = Depth::uint8}),
                 std::invalid_argument);
    EXPECT_EQ(all_of(canvas), std::string(20, '\0'));
}

TEST(Canvas, HashesItsBytesInRowOrder) {
    Canvas canvas({.width = 3, .height = 1, .channels = 1, .depth = Depth::uint8});
    canvas.place(canvas.bounds(), as_bytes("abc"), canvas.bounds());
    // FIPS 180-2, appendix A.1.
    EXPECT_EQ(canvas.sha1(), "a9993e364706816aba3e25717850c26c9cd0d89d");
}

TEST(Canvas, CostsNothingBeforeItIsUsed) {
    // 200 GB, more than the machine has: only one page of it is touched.
    Canvas canvas({.width = 250'000, .height = 100'000, .channels = 4, .depth = Depth::uint16});
    canvas.place({249'999, 99'999, 250'000, 100'000}, as_bytes("12345678"), canvas.bounds());
    EXPECT_EQ(as_text(canvas.read({249'999, 99'999, 250'000, 100'000})), "12345678");
}

TEST(Canvas, IsOpaqueBlackAroundARegion) {
    for (const Depth depth : {Depth::uint8, Depth::uint16, Depth::half, Depth::float32}) {
        Canvas canvas({.width = 4, .height = 3, .channels = 2, .depth = depth});
        const Rect region{1, 1, 3, 2};
        const auto inside = canvas.read(region);
        canvas.make_opaque_outside(region);
        EXPECT_EQ(canvas.read(region), inside);
        const std::size_t size = canvas.layout().bytes_per_pixel() / 2;
        const auto corner = canvas.read({0, 0, 1, 1});
        const auto zero = std::vector<std::byte>(size);
        EXPECT_TRUE(std::equal(zero.begin(), zero.end(), corner.begin())) << "colour";
        for (const Rect& one : {Rect{0, 0, 1, 1}, Rect{3, 0, 4, 1}, Rect{0, 1, 1, 2},
                                Rect{3, 1, 4, 2}, Rect{1, 2, 2, 3}, Rect{3, 2, 4, 3}})
            EXPECT_EQ(canvas.read(one), corner);
        const float one = 1;
        std::vector<std::byte> full(size, std::byte{0xff});
        if (depth == Depth::float32) std::memcpy(full.data(), &one, size);
        if (depth == Depth::half) full = {std::byte{0x00}, std::byte{0x3c}};
        EXPECT_TRUE(std::equal(full.begin(), full.end(), corner.end() - static_cast<long>(size)));
    }
    Canvas canvas({.width = 2, .height = 1, .channels = 3, .depth = Depth::uint8});
    canvas.make_opaque_outside({0, 0, 1, 1});
    EXPECT_EQ(canvas.read(canvas.bounds()), std::vector<std::byte>(6)) << "no alpha";
}

TEST(DifferingPixels, CountsPixelsAndFindsTheLargestStep) {
    Canvas canvas({.width = 3, .height = 2, .channels = 2, .depth = Depth::uint8});
    canvas.place(canvas.bounds(), as_bytes("aabbccddeeff"), canvas.bounds());
    const Rect strip{1, 0, 3, 2};
    const auto compare = [&](const std::string& pixels, const Rect& within) {
        return differing_pixels(canvas, strip, as_bytes(pixels), within);
    };
    EXPECT_EQ(compare("bbcceeff", strip).pixels, 0);
    const Difference difference = compare("bdcceegi", strip);
    EXPECT_EQ(difference.pixels, 2);
    EXPECT_EQ(difference.largest, 3);
    EXPECT_EQ(compare("bdcceegi", {1, 0, 3, 1}).largest, 2);
    EXPECT_EQ(compare("bdcceegi", {0, 0, 1, 2}).pixels, 0);
    EXPECT_THROW(compare("bdcceeg", strip), std::invalid_argument);
}

template <typename Value>
Difference compare_values(Depth depth, Value a, Value b) {
    Canvas canvas({.width = 1, .height = 1, .channels = 1, .depth = depth});
    canvas.place(canvas.bounds(), std::as_bytes(std::span(&a, 1)), canvas.bounds());
    return differing_pixels(canvas, canvas.bounds(), std::as_bytes(std::span(&b, 1)),
                            canvas.bounds());
}

TEST(DifferingPixels, MeasuresInTheUnitsOfTheFile) {
    EXPECT_EQ(compare_values<std::uint16_t>(Depth::uint16, 60'000, 100).largest, 59'900);
    EXPECT_EQ(compare_values<float>(Depth::float32, 0.25F, -2).largest, 2.25);
    // Half 1.0 is 3c00 and 2.0 is 4000.
    EXPECT_EQ(compare_values<std::uint16_t>(Depth::half, 0x3c00, 0x4000).largest, 1);
    EXPECT_EQ(compare_values<std::uint16_t>(Depth::half, 0x3c00, 0x3c00).pixels, 0);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(compare_values<float>(Depth::float32, nan, nan).pixels, 0);
    EXPECT_TRUE(std::isinf(compare_values<float>(Depth::float32, nan, 1).largest));
}

}  // namespace
}  // namespace mpipov
