#include "image_source.h"

#include "failure.h"
#include "scratch.h"
#include "test_image.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <limits>

#ifdef __SANITIZE_ADDRESS__
// OpenImageIO 2.4's PNG reader loses one string when libpng jumps out of a truncated file
// (PNGInput::PngReadCallback); the sanitizer's fast unwinder sees no further than geterror.
// NOLINTNEXTLINE(bugprone-reserved-identifier): the name that LeakSanitizer looks for
extern "C" const char* __lsan_default_suppressions() {
    return "leak:ImageInput::geterror";
}
#endif

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using OIIO::TypeDesc;

std::vector<double> read_all(const fs::path& file, int rows) {
    ImageSource source(file);
    std::vector<double> values;
    ImageBand band;
    while (source.next_band(rows, band))
        values.insert(values.end(), band.values.begin(), band.values.end());
    return values;
}

std::string failure_of(const fs::path& file) {
    try {
        read_all(file, 8);
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), Exit::file);
        return failure.what();
    }
    return "no failure";
}

struct FileKind {
    const char* name;
    TypeDesc type;
    int channels;
};

class ImageSourceOf : public testing::TestWithParam<FileKind> {};

TEST_P(ImageSourceOf, GivesTheStoredValuesInBandsOfAnySize) {
    const auto& [name, type, channels] = GetParam();
    const ScratchFolder folder("test");
    const fs::path file = folder.path() / name;
    TestImage image = textured(37, 23, channels);
    if (type == TypeDesc::UINT16)
        for (double& value : image.values) value *= 256.5;
    write_image(file, image, type);
    std::vector<double> expected;
    for (const double value : image.values) {
        if (!type.is_floating_point())
            expected.push_back(std::floor(value));
        else
            expected.push_back(static_cast<float>(value / 255));
    }
    for (const int rows : {1, 7, 64}) {
        const std::vector<double> found = read_all(file, rows);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            if (type == TypeDesc::HALF)
                ASSERT_NEAR(found[i], expected[i], 5e-4) << i;
            else
                ASSERT_EQ(found[i], expected[i]) << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ImageSourceOf,
                         testing::Values(FileKind{"a.png", TypeDesc::UINT8, 3},
                                         FileKind{"rgba.png", TypeDesc::UINT8, 4},
                                         FileKind{"gray.png", TypeDesc::UINT8, 1},
                                         FileKind{"deep.png", TypeDesc::UINT16, 3},
                                         FileKind{"deep_rgba.png", TypeDesc::UINT16, 4},
                                         FileKind{"a.ppm", TypeDesc::UINT8, 3},
                                         FileKind{"a.tga", TypeDesc::UINT8, 4},
                                         FileKind{"a.bmp", TypeDesc::UINT8, 3},
                                         FileKind{"float.exr", TypeDesc::FLOAT, 3},
                                         FileKind{"half.exr", TypeDesc::HALF, 4}),
                         [](const auto& kind) {
                             std::string name = kind.param.name;
                             std::replace(name.begin(), name.end(), '.', '_');
                             return name;
                         });

TEST(ImageSource, KnowsTheFormat) {
    const ScratchFolder folder("test");
    const fs::path file = folder.path() / "a.png";
    write_image(file, textured(5, 4, 4), TypeDesc::UINT16);
    const ImageSource source(file);
    EXPECT_EQ(source.format().width, 5);
    EXPECT_EQ(source.format().height, 4);
    EXPECT_THAT(source.format().channels, testing::ElementsAre("R", "G", "B", "A"));
    EXPECT_EQ(source.format().alpha, 3);
    EXPECT_EQ(source.format().type, "png");
    EXPECT_EQ(source.format().depth, "uint16");
    EXPECT_EQ(source.format().full_scale(), 65535);
}

TEST(ImageSource, KeepsWhatIsNotFinite) {
    const ScratchFolder folder("test");
    for (const TypeDesc& type : {TypeDesc(TypeDesc::HALF), TypeDesc(TypeDesc::FLOAT)}) {
        const fs::path file = folder.path() / "a.exr";
        TestImage image = textured(5, 4);
        image.at(1, 2, 0) = std::numeric_limits<double>::quiet_NaN();
        image.at(2, 2, 0) = -std::numeric_limits<double>::infinity();
        write_image(file, image, type);
        const std::vector<double> values = read_all(file, 3);
        // Pixel (1, 2) of 5 columns and 3 channels, and the one after it.
        EXPECT_TRUE(std::isnan(values[33]));
        EXPECT_EQ(values[36], -std::numeric_limits<double>::infinity());
    }
}

TEST(ImageSource, NamesTheFileThatCannotBeRead) {
    const ScratchFolder folder("test");
    EXPECT_THAT(
        failure_of(folder.path() / "none.png"),
        testing::AllOf(testing::HasSubstr("none.png'"), testing::HasSubstr("no such file")));
    EXPECT_THAT(failure_of(folder.path()), testing::HasSubstr("it is a folder"));
    const fs::path text = folder.path() / "text.png";
    std::ofstream(text) << "not an image";
    EXPECT_THAT(failure_of(text), testing::HasSubstr("text.png"));
}

TEST(ImageSource, AFileThatEndsEarlyIsAnError) {
    const ScratchFolder folder("test");
    for (const char* name : {"a.png", "a.exr", "a.ppm", "a.bmp", "a.tga"}) {
        const fs::path file = folder.path() / name;
        write_image(file, textured(64, 64),
                    name == std::string("a.exr") ? TypeDesc::FLOAT : TypeDesc::UINT8);
        ASSERT_EQ(read_all(file, 8).size(), 64U * 64U * 3U) << name;
        fs::resize_file(file, fs::file_size(file) / 2);
        EXPECT_THAT(failure_of(file), testing::HasSubstr(name));
    }
}

TEST(ImageSource, RefusesATiledFile) {
    const ScratchFolder folder("test");
    const fs::path file = folder.path() / "tiled.exr";
    OIIO::ImageSpec spec(64, 64, 3, TypeDesc::FLOAT);
    spec.tile_width = spec.tile_height = 32;
    auto output = OIIO::ImageOutput::create(file.string());
    ASSERT_TRUE(output->open(file.string(), spec));
    const std::vector<float> pixels(std::size_t{64} * 64 * 3);
    ASSERT_TRUE(output->write_image(TypeDesc::FLOAT, pixels.data()));
    output->close();
    EXPECT_THAT(failure_of(file), testing::HasSubstr("--scanline"));
}

TEST(WriteGrayImage, IsWholeOrNotThere) {
    const ScratchFolder folder("test");
    const std::vector<float> values{0, 0.25F, 0.5F, 1};
    write_gray_image(folder.path() / "map.exr", 2, 2, values);
    EXPECT_THAT(read_all(folder.path() / "map.exr", 9), testing::ElementsAre(0, 0.25, 0.5, 1));
    write_gray_image(folder.path() / "map.png", 2, 2, values);
    EXPECT_THAT(read_all(folder.path() / "map.png", 9), testing::ElementsAre(0, 64, 128, 255));
    EXPECT_THROW(write_gray_image(folder.path() / "map.nonsense", 2, 2, values), Failure);
    EXPECT_THROW(write_gray_image(folder.path() / "no" / "map.png", 2, 2, values), Failure);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2);
}

}  // namespace
}  // namespace mpipov
