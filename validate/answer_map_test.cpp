#include "answer_map.h"

#include "image_source.h"
#include "scratch.h"
#include "test_image.h"

#include <gtest/gtest.h>

#include <limits>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using OIIO::TypeDesc;

class AnswerMaps : public testing::Test {
  protected:
    fs::path save(const char* name, const TestImage& image, const TypeDesc& type) const {
        fs::path file = folder_.path() / name;
        write_image(file, image, type);
        return file;
    }

    ScratchFolder folder_{"test"};
    TestImage still_ = textured(12, 9);
};

TEST_F(AnswerMaps, APixelAnswersByMoreThanALevelOf255) {
    TestImage moved = still_;
    moved.at(3, 4, 1) += 2;
    moved.at(3, 4, 2) += 2;
    moved.at(5, 4, 0) += 1;
    AnswerMap map(save("a.png", still_, TypeDesc::UINT8));
    EXPECT_EQ(map.add(save("b.png", moved, TypeDesc::UINT8), 1e-12), 1);
    EXPECT_EQ(map.add(folder_.path() / "a.png", 1e-9), 0);

    TestImage wide = still_;
    wide.at(0, 0, 0) += 257;
    wide.at(1, 0, 0) += 258;
    AnswerMap of_wide(save("c.png", still_, TypeDesc::UINT16));
    EXPECT_EQ(of_wide.add(save("d.png", wide, TypeDesc::UINT16), 1e-12), 1);

    TestImage infinite = moved;
    infinite.at(7, 7, 0) = std::numeric_limits<double>::infinity();
    AnswerMap of_floats(save("e.exr", still_, TypeDesc::FLOAT));
    EXPECT_EQ(of_floats.add(save("f.exr", infinite, TypeDesc::FLOAT), 1e-12), 2);
}

TEST_F(AnswerMaps, TheSmallerTheMoveTheBrighter) {
    TestImage small = still_, large = still_;
    small.at(2, 2, 0) += 5;
    large.at(2, 2, 0) += 5;
    large.at(6, 7, 0) += 5;
    AnswerMap map(save("a.png", still_, TypeDesc::UINT8));
    map.add(save("b.png", small, TypeDesc::UINT8), 1e-12);
    map.add(save("c.png", large, TypeDesc::UINT8), 1e-6);
    map.write(folder_.path() / "map.png");
    ImageSource source(folder_.path() / "map.png");
    ImageBand band;
    ASSERT_TRUE(source.next_band(9, band));
    EXPECT_EQ(band.row(2)[2], 255);
    EXPECT_EQ(band.row(7)[6], 128);
    EXPECT_EQ(band.row(0)[0], 0);
}

TEST_F(AnswerMaps, OnlyAnAnswerAsLargeAndNextToItExplains) {
    TestImage moved = still_, far = still_;
    moved.at(4, 4, 0) += 20;
    far.at(10, 1, 0) += 200;
    const fs::path reference = save("a.png", still_, TypeDesc::UINT8);
    AnswerMap map(reference);
    map.add(save("b.png", moved, TypeDesc::UINT8), 1e-9);
    map.add(save("c.png", far, TypeDesc::UINT8), 1e-6);
    const auto unexplained = [&](int x, int y, double by) {
        TestImage image = still_;
        image.at(x, y, 2) += by;
        const auto found = map.explain(reference, save("d.png", image, TypeDesc::UINT8));
        EXPECT_EQ(found.all, 1);
        return found.unexplained;
    };
    EXPECT_EQ(unexplained(4, 4, 10), 0);
    EXPECT_EQ(unexplained(5, 3, 10), 0);
    EXPECT_EQ(unexplained(4, 4, 21), 1) << "by more than the picture answers";
    EXPECT_EQ(unexplained(6, 4, 1), 1) << "beside it, but not next to it";
    EXPECT_EQ(unexplained(10, 1, 1), 1) << "1e-6 is not nothing";
    EXPECT_EQ(map.explain(reference, reference).all, 0);
}

}  // namespace
}  // namespace mpipov
