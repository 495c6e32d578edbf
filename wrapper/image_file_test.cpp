#include "image_file.h"

#include "image_test_support.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <string>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

std::vector<std::byte> crop(const std::vector<std::byte>& frame, const PixelLayout& layout,
                            const Rect& rect) {
    std::vector<std::byte> out;
    const std::size_t pixel = layout.bytes_per_pixel();
    for (int y = rect.y0; y < rect.y1; ++y) {
        const auto row = frame.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) *
                                                                     layout.row_bytes());
        out.insert(out.end(), row + static_cast<std::ptrdiff_t>(pixel) * rect.x0,
                   row + static_cast<std::ptrdiff_t>(pixel) * rect.x1);
    }
    return out;
}

std::vector<std::byte> read_section(const fs::path& file, const PixelLayout& layout,
                                    const Rect& rect, std::size_t max_bytes) {
    SectionReader reader(file, layout.width, layout.height, rect, max_bytes);
    std::vector<std::byte> out;
    int y = rect.y0;
    while (const auto band = reader.next()) {
        EXPECT_EQ(band->rect.x0, rect.x0);
        EXPECT_EQ(band->rect.x1, rect.x1);
        EXPECT_EQ(band->rect.y0, y);
        EXPECT_EQ(band->pixels.size(),
                  static_cast<std::size_t>(band->rect.area()) * layout.bytes_per_pixel());
        if (band->rect.height() > 1) {
            EXPECT_LE(band->pixels.size(), max_bytes);
        }
        y = band->rect.y1;
        out.insert(out.end(), band->pixels.begin(), band->pixels.end());
    }
    EXPECT_EQ(y, rect.y1);
    EXPECT_FALSE(reader.next());
    return out;
}

void expect_error(const fs::path& file, const std::string& why,
                  const std::function<void()>& action) {
    try {
        action();
        ADD_FAILURE() << "no error: " << why;
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr(file.string()), HasSubstr(why)));
    }
}

struct FormatCase {
    std::string name, type, extension;
    int channels;
    Depth depth;
};

void PrintTo(const FormatCase& c, std::ostream* out) {
    *out << c.name;
}

std::string name_of(const testing::TestParamInfo<FormatCase>& info) {
    return info.param.name;
}

class EveryFormat : public testing::TestWithParam<FormatCase> {
  protected:
    const FormatCase& format_ = GetParam();
    PixelLayout layout_{
        .width = 41, .height = 37, .channels = format_.channels, .depth = format_.depth};
    ScratchFolder folder_{"image-file-test"};
    fs::path file_ = folder_.path() / ("frame" + format_.extension);
};

TEST_P(EveryFormat, GivesTheLayoutAndTheCroppedPixels) {
    write_pattern(file_, layout_, format_.type);
    const std::vector<std::byte> frame = decode(file_).pixels;
    EXPECT_EQ(read_layout(file_), layout_);
    for (const Rect& rect : {Rect{0, 0, 41, 37}, Rect{5, 3, 6, 4}, Rect{17, 20, 41, 37},
                             Rect{0, 36, 41, 37}, Rect{2, 1, 39, 35}})
        for (const std::size_t max_bytes : {std::size_t{1}, std::size_t{700}, std::size_t{1} << 20})
            EXPECT_EQ(read_section(file_, layout_, rect, max_bytes), crop(frame, layout_, rect))
                << rect.x0 << ' ' << rect.y0 << ", bands of " << max_bytes;
}

TEST_P(EveryFormat, NamesATruncatedFile) {
    write_pattern(file_, layout_, format_.type);
    const auto size = fs::file_size(file_);
    for (const auto left : {size / 2, size / 4, std::uintmax_t{20}, std::uintmax_t{3}}) {
        fs::resize_file(file_, left);
        expect_error(file_, "cannot read", [&] {
            read_section(file_, layout_, {0, 0, 41, 37}, 1000);
        });
    }
}

TEST_P(EveryFormat, NamesAnEmptyAMissingAndAForeignFile) {
    write_text(file_, "");
    expect_error(file_, "empty", [&] { read_layout(file_); });
    write_text(file_, std::string(4000, 'x'));
    expect_error(file_, "cannot read", [&] { read_section(file_, layout_, {0, 0, 41, 37}, 1000); });
    fs::remove(file_);
    expect_error(file_, "No such file", [&] { read_layout(file_); });
}

TEST_P(EveryFormat, NamesAFrameOfAnotherSize) {
    write_pattern(file_, layout_, format_.type);
    expect_error(file_, "41x37 pixels where 40x37 are expected", [&] {
        SectionReader(file_, 40, 37, {0, 0, 40, 37});
    });
    EXPECT_THROW(SectionReader(file_, 41, 37, {0, 0, 42, 37}), std::invalid_argument);
    EXPECT_THROW(SectionReader(file_, 41, 37, {5, 5, 5, 9}), std::invalid_argument);
}

TEST_P(EveryFormat, ReadsAnImageOfOnePixel) {
    layout_.width = layout_.height = 1;
    write_pattern(file_, layout_, format_.type);
    EXPECT_EQ(read_section(file_, layout_, {0, 0, 1, 1}, 1), decode(file_).pixels);
}

INSTANTIATE_TEST_SUITE_P(Types, EveryFormat,
                         testing::Values(FormatCase{"png8", "png", ".png", 3, Depth::uint8},
                                         FormatCase{"png16_alpha", "png", ".png", 4, Depth::uint16},
                                         FormatCase{"png16_gray", "png", ".png", 1, Depth::uint16},
                                         FormatCase{"exr", "openexr", ".exr", 3, Depth::half},
                                         FormatCase{"exr_alpha", "openexr", ".exr", 4, Depth::half},
                                         FormatCase{"hdr", "hdr", ".hdr", 3, Depth::float32},
                                         FormatCase{"targa", "targa", ".tga", 4, Depth::uint8},
                                         FormatCase{"bmp", "bmp", ".bmp", 3, Depth::uint8},
                                         FormatCase{"ppm", "pnm", ".ppm", 3, Depth::uint8}),
                         name_of);

TEST(ImageFile, ReadsPnmOfSixteenBitsWithComments) {
    const ScratchFolder folder("image-file-test");
    const fs::path file = folder.path() / "wide.ppm";
    write_text(file, "P6\n# 9 9 255\n2  1 # and more\n65535\nAaBbCcDdEeFf");
    const PixelLayout layout{.width = 2, .height = 1, .channels = 3, .depth = Depth::uint16};
    EXPECT_EQ(read_layout(file), layout);
    EXPECT_EQ(as_text(read_section(file, layout, {0, 0, 2, 1}, 99)), "aAbBcCdDeEfF");
    EXPECT_EQ(read_section(file, layout, {0, 0, 2, 1}, 99), decode(file).pixels);
    write_text(file, "P5\n2 1\n255\nabcd");
    expect_error(file, "PGM", [&] { read_layout(file); });
    for (const std::string header :
         {"P6\n", "P6\n-2 1 255\n", "P6\n99999999999 1\n255\n", "P6\n2 1\n0\n",
          "P6\n2 1\n1023\nabcdef", "P6\n2x1 255\nabcdef"}) {
        write_text(file, header);
        expect_error(file, "PNM", [&] { read_layout(file); });
    }
}

TEST(ImageFile, DepthsHaveTheNamesOfTheRecord) {
    for (const Depth depth : {Depth::uint8, Depth::uint16, Depth::half, Depth::float32})
        EXPECT_EQ(depth_from_string(to_string(depth)), depth);
    EXPECT_EQ(to_string(Depth::float32), "float");
    EXPECT_THROW(depth_from_string("int"), std::invalid_argument);
}

// The section is cropped from the frame that POV-Ray writes for it: the rest of it is zero.
TEST(ImageFile, CropsASectionThatPovrayRendered) {
    if (!povray_on_path()) GTEST_SKIP() << "no povray on the PATH";
    const ScratchFolder folder("image-file-test");
    const fs::path serial = render(folder.path(), "serial", "+W64 +H48 +FN8 +UA");
    const fs::path part =
        render(folder.path(), "part", "+W64 +H48 +FN8 +UA +SC33 +EC64 +SR1 +ER32");
    const PixelLayout layout{.width = 64, .height = 48, .channels = 4, .depth = Depth::uint8};
    const Rect section{32, 0, 64, 32};
    const auto pixels = read_section(part, layout, section, 1000);
    EXPECT_EQ(pixels, crop(decode(serial).pixels, layout, section));
    EXPECT_NE(decode(part).pixels, decode(serial).pixels);
}

}  // namespace
}  // namespace mpipov
