// write_image against POV-Ray's own files: same pixels, same metadata.
#include "image_test_support.h"
#include "png_chunks.h"
#include "stitch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <map>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

Canvas canvas_of(const fs::path& file) {
    const PixelLayout layout = read_layout(file);
    Canvas canvas(layout);
    SectionReader reader(file, layout.width, layout.height, canvas.bounds(), 1000);
    while (const auto band = reader.next()) canvas.place(band->rect, band->pixels, canvas.bounds());
    return canvas;
}

// Times of rendering differ between two files, and nothing else may: 2026-11-22 20:49:46, in a PNG
// also with colons.
std::string without_dates(std::string text) {
    constexpr std::string_view form = "0000-00-00 00:00:00";
    const auto fits = [](char c, char expected) {
        if (expected == '0') return c >= '0' && c <= '9';
        return c == expected || (expected == '-' && c == ':');
    };
    for (std::size_t at = 0; at + form.size() <= text.size(); ++at)
        if (std::equal(form.begin(), form.end(), text.begin() + static_cast<std::ptrdiff_t>(at),
                       [&](char expected, char c) { return fits(c, expected); }))
            text.replace(at, form.size(), "<date>");
    return text;
}

using Attributes = std::map<std::string, std::string>;

Attributes attributes_of(const OIIO::ImageSpec& spec) {
    Attributes found;
    for (const auto& attribute : spec.extra_attribs)
        found[attribute.name().string()] = without_dates(attribute.get_string());
    return found;
}

std::vector<std::pair<std::string, std::string>> chunks_of(const fs::path& png) {
    std::vector<std::pair<std::string, std::string>> found;
    for (const PngChunk& chunk : read_png_metadata(png)) {
        // Between length and type at the front and the CRC at the end.
        const std::string data =
            as_text(std::span(chunk.bytes).subspan(8, chunk.bytes.size() - 12));
        found.emplace_back(chunk.type, chunk.type == "tIME" ? "" : without_dates(data));
    }
    return found;
}

bool has_soft_alpha(const Decoded& image) {
    const auto& spec = image.spec;
    const std::size_t value = spec.format.size();
    const std::string none(value, '\0');
    const std::string opaque =
        spec.format == OIIO::TypeHalf ? std::string("\x00\x3c", 2) : std::string(value, '\xff');
    const auto pixel = static_cast<std::size_t>(spec.nchannels) * value;
    for (std::size_t at = pixel - value; at < image.pixels.size(); at += pixel) {
        const std::string alpha = as_text(std::span(image.pixels).subspan(at, value));
        if (alpha != none && alpha != opaque) return true;
    }
    return false;
}

struct WriteCase {
    std::string name;
    std::string options;  // POV-Ray's, for the file that ours is to equal
    std::string type;
    std::string sections;  // of what type the pixels are rendered, where it is another
    int quality = 0;
    bool rle = false;
    bool same_bytes = false;  // with POV-Ray's own file as the sample, ours equals it byte for byte
};

void PrintTo(const WriteCase& c, std::ostream* out) {
    *out << c.options;
}

std::string name_of(const testing::TestParamInfo<WriteCase>& info) {
    return info.param.name;
}

class WritesLikePovray : public testing::TestWithParam<WriteCase> {};

TEST_P(WritesLikePovray, PixelsAndMetadata) {
    if (!povray_on_path()) GTEST_SKIP() << "no povray on the PATH";
    const WriteCase& c = GetParam();
    const ScratchFolder folder("stitch-write-test");
    const fs::path serial = render(folder.path(), "serial", "+W50 +H38 " + c.options);
    const fs::path sample = render(folder.path(), "sample", "+W20 +H12 " + c.options);
    const fs::path source =
        c.sections.empty() ? serial : render(folder.path(), "source", "+W50 +H38 " + c.sections);
    const Canvas canvas = canvas_of(source);

    const fs::path ours = folder.path() / ("ours" + serial.extension().string());
    FileStyle style{.type = c.type,
                    .extension = serial.extension(),
                    .jpeg_quality = c.quality,
                    .rle = c.rle,
                    .sample = sample};
    write_image(canvas, style, ours);

    const Decoded expected = decode(serial);
    const Decoded found = decode(ours);
    EXPECT_TRUE(found.pixels == expected.pixels);
    EXPECT_EQ(found.spec.format, expected.spec.format);
    EXPECT_EQ(found.spec.channelnames, expected.spec.channelnames);
    // OpenImageIO 2.4 decodes some values of a PNM of 16 bits one level too low.
    if (c.type != "jpeg" && !(c.type == "pnm" && canvas.layout().depth == Depth::uint16)) {
        EXPECT_TRUE(canvas.read(canvas.bounds()) == expected.pixels);
    }
    if (expected.spec.alpha_channel >= 0) {
        EXPECT_TRUE(has_soft_alpha(expected)) << "the scene no longer shows an error in alpha";
    }

    Attributes attributes = attributes_of(found.spec);
    // OpenImageIO adds the time of writing to an EXR, as capDate.
    if (c.type == "openexr") attributes.erase("DateTime");
    EXPECT_EQ(attributes, attributes_of(expected.spec));
    if (c.type == "png") {
        EXPECT_EQ(chunks_of(ours), chunks_of(serial));
    }
    if (c.same_bytes) {
        style.sample = serial;
        write_image(canvas, style, ours);
        EXPECT_TRUE(read_text(ours) == read_text(serial));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Types, WritesLikePovray,
    testing::Values(
        WriteCase{"N8", "+FN8", "png", ""}, WriteCase{"N8_alpha", "+FN8 +UA", "png", ""},
        WriteCase{"N16", "+FN16", "png", ""}, WriteCase{"N16_alpha", "+FN16 +UA", "png", ""},
        WriteCase{"N_gray", "+FNg", "png", ""}, WriteCase{"N_gray_alpha", "+FNg +UA", "png", ""},
        WriteCase{"N8_gamma1", "+FN8 File_Gamma=1.0", "png", ""},
        WriteCase{"N8_gamma22", "+FN8 File_Gamma=2.2", "png", ""},
        WriteCase{"E", "+FE", "openexr", ""}, WriteCase{"E_alpha", "+FE +UA", "openexr", ""},
        WriteCase{"H", "+FH", "hdr", "", 0, false, true},
        WriteCase{"P", "+FP", "pnm", "", 0, false, true},
        WriteCase{"P_from_png", "+FP", "pnm", "+FN8", 0, false, true},
        WriteCase{"P16", "+FP16", "pnm", "", 0, false, true},
        WriteCase{"P16_from_png", "+FP16", "pnm", "+FN16", 0, false, true},
        WriteCase{"P16_gamma_from_png", "+FP16 File_Gamma=1.8", "pnm", "+FN16 File_Gamma=1.8", 0,
                  false, true},
        WriteCase{"P16_gray", "+FPg Bits_Per_Color=16", "pnm", "", 0, false, true},
        WriteCase{"T", "+FT", "targa", ""}, WriteCase{"T_alpha", "+FT +UA", "targa", ""},
        WriteCase{"T_from_png", "+FT", "targa", "+FN8"},
        WriteCase{"T_alpha_from_png", "+FT +UA", "targa", "+FN8 +UA"},
        WriteCase{"T_gamma_from_png", "+FT +UA File_Gamma=1.8", "targa", "+FN8 +UA File_Gamma=1.8"},
        WriteCase{"C", "+FC", "targa", "", 0, true, true},
        WriteCase{"C_alpha_from_png", "+FC +UA", "targa", "+FN8 +UA", 0, true, true},
        WriteCase{"B", "+FB", "bmp", ""}, WriteCase{"B_alpha", "+FB +UA", "bmp", ""},
        WriteCase{"B_alpha_from_png", "+FB +UA", "bmp", "+FN8 +UA"},
        WriteCase{"J", "+FJ", "jpeg", "+FP", 85, false, true},
        WriteCase{"J_quality", "+FJ Compression=60", "jpeg", "+FP", 60, false, true},
        WriteCase{"J_alpha", "+FJ +UA", "jpeg", "+FP +UA", 85, false, true},
        WriteCase{"J_gamma", "+FJ +UA File_Gamma=1.8", "jpeg", "+FP +UA File_Gamma=1.8", 85, false,
                  true}),
    name_of);

class WriteImage : public testing::Test {
  protected:
    WriteImage() : canvas_(make_canvas()) {}

    Canvas make_canvas() {
        write_pattern(style_.sample, {.width = 90, .height = 70, .channels = 4}, "png");
        return canvas_of(style_.sample);
    }

    std::string error_of(const fs::path& file) {
        try {
            write_image(canvas_, style_, file);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "no error";
    }

    ScratchFolder folder_{"stitch-write-test"};
    FileStyle style_{.type = "png",
                     .extension = ".png",
                     .jpeg_quality = 0,
                     .rle = false,
                     .sample = folder_.path() / "sample.png"};
    fs::path file_ = folder_.path() / "out.part";
    Canvas canvas_;
};

TEST_F(WriteImage, KeepsColoursWhereAlphaIsZero) {
    write_image(canvas_, style_, file_);
    fs::rename(file_, folder_.path() / "out.png");
    EXPECT_TRUE(decode(folder_.path() / "out.png").pixels == canvas_.read(canvas_.bounds()));
}

TEST_F(WriteImage, NamesAFullDisk) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
    EXPECT_THAT(error_of("/dev/full"),
                HasSubstr("cannot write '/dev/full': No space left on device"));
    EXPECT_TRUE(fs::exists("/dev/full"));
}

TEST_F(WriteImage, LeavesNoHalfFile) {
    // A disk that is full after 100 bytes.
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit tight{.rlim_cur = 100, .rlim_max = before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &tight), 0);
    const std::string error = error_of(file_);
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_THAT(error, HasSubstr("cannot write '" + file_.string() + "': File too large"));
    EXPECT_FALSE(fs::exists(file_));
}

TEST_F(WriteImage, NamesAFolderThatIsMissing) {
    EXPECT_THAT(error_of(folder_.path() / "none" / "out.png"), HasSubstr("No such file"));
}

TEST_F(WriteImage, NamesASampleThatDoesNotFit) {
    write_pattern(style_.sample, {.width = 4, .height = 4, .channels = 3}, "png");
    EXPECT_THAT(error_of(file_), HasSubstr("4 channels of uint8"));
    EXPECT_FALSE(fs::exists(file_));
    style_.type = "targa";
    EXPECT_THAT(error_of(file_), HasSubstr("targa"));
    fs::remove(style_.sample);
    EXPECT_THAT(error_of(file_), HasSubstr(style_.sample.string()));
}

TEST_F(WriteImage, WantsAQualityForJpeg) {
    style_ = {.type = "jpeg",
              .extension = ".jpg",
              .jpeg_quality = 0,
              .rle = false,
              .sample = folder_.path() / "sample.jpg"};
    canvas_ = Canvas({.width = 9, .height = 7, .channels = 3, .depth = Depth::uint8});
    write_pattern(style_.sample, {.width = 4, .height = 4, .channels = 3}, "jpeg");
    EXPECT_THAT(error_of(file_), HasSubstr("quality 0"));
    style_.jpeg_quality = 90;
    EXPECT_EQ(error_of(file_), "no error");
}

TEST_F(WriteImage, WritesOnePixel) {
    canvas_ = Canvas({.width = 1, .height = 1, .channels = 4, .depth = Depth::uint8});
    canvas_.place(canvas_.bounds(), as_bytes("\x10\x20\x30\x40"), canvas_.bounds());
    const fs::path file = folder_.path() / "one.png";
    write_image(canvas_, style_, file);
    EXPECT_EQ(as_text(decode(file).pixels), "\x10\x20\x30\x40");
}

}  // namespace
}  // namespace mpipov
