// Noisy images of which it is known what was done to them: damage has to be found, at its place,
// and noise of the same kind has to pass.
#include "seam_judge.h"

#include "failure.h"
#include "scratch.h"
#include "seam_verdict.h"
#include "test_image.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace mpipov {
namespace {

using OIIO::TypeDesc;
constexpr int width = 96, height = 96, strip = 24;

// Four strips of 24 columns, seams at 24, 48 and 72; 13 equally right renders.
class Noisy : public testing::Test {
  protected:
    // Noise like a render's: none in the upper third, and now and then a sample that jumps, as
    // antialiasing does.
    TestImage draw() {
        TestImage image = scene_;
        std::normal_distribution<double> noise(0, sigma_);
        std::uniform_int_distribution<int> rarely(0, 4000);
        for (int y = height / 3; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < 3; ++c) {
                    const double jump = rarely(random_) == 0 ? 15 : 0;
                    double& value = image.at(x, y, c);
                    value = std::clamp(std::round(value + noise(random_) + jump), 0.0, 255.0);
                }
        return image;
    }

    SeamJudge make_judge(const TypeDesc& type = TypeDesc::UINT8) {
        std::vector<std::filesystem::path> files;
        for (int i = 0; i < 13; ++i) {
            files.push_back(file(fmt::format("render{}", i), type));
            write_image(files.back(), draw(), type);
        }
        return SeamJudge(files);
    }

    std::filesystem::path file(const std::string& name, const TypeDesc& type) const {
        return folder_.path() / (name + (type.is_floating_point() ? ".exr" : ".png"));
    }

    Judgement judge(SeamJudge& judge, const TestImage& image,
                    const TypeDesc& type = TypeDesc::UINT8) {
        const auto path = file("image", type);
        write_image(path, image, type);
        return judge.judge({path, run_of(width, height, Shape::columns, 4), {}});
    }

    // At least half of the samples found lie in `place`, all but a stray one, and so does the
    // largest.
    static void expect_pixels_in(const Judgement& found, const Rect& place) {
        EXPECT_TRUE(found.pixel.alarm());
        ASSERT_TRUE(found.pixel.at);
        EXPECT_TRUE(place.contains(found.pixel.at->x, found.pixel.at->y))
            << found.pixel.at->x << ',' << found.pixel.at->y;
        EXPECT_EQ(intersect(found.pixel.beyond_box, place), found.pixel.beyond_box);
    }

    ScratchFolder folder_{"test"};
    TestImage scene_ = textured(width, height);
    double sigma_ = 2;
    std::mt19937 random_{20};  // NOLINT: the same images in every run
};

TEST_F(Noisy, TwentyEquallyRightImagesAreQuiet) {
    SeamJudge all = make_judge();
    int alarms = 0;
    for (int i = 0; i < 20; ++i) {
        const Judgement found = judge(all, draw());
        alarms += found.alarm() ? 1 : 0;
        EXPECT_LE(found.quiet.alarms, 2);  // of 13; each test has 0.01 of them
        EXPECT_EQ(found.quiet.renders, 13);
    }
    // Two tests at 0.01: of 20 images 0.4 on the average, and more than 3 once in 1,000.
    EXPECT_LE(alarms, 3);
}

TEST_F(Noisy, OneLevelAddedToASection) {
    SeamJudge all = make_judge();
    TestImage image = draw();
    for (int y = 0; y < height; ++y)
        for (int x = strip; x < 2 * strip; ++x)
            for (int c = 0; c < 3; ++c) image.at(x, y, c) += 1;
    const Judgement found = judge(all, image);
    EXPECT_TRUE(found.step.alarm());
    ASSERT_TRUE(found.step.at);
    EXPECT_THAT(found.step.at->line.position, testing::AnyOf(strip, 2 * strip));
    EXPECT_EQ(found.step.controls_beyond, 0);
    EXPECT_NEAR(std::abs(found.step.step - found.step.expected), 1, 0.4);
}

TEST_F(Noisy, TwoSectionsSwapped) {
    SeamJudge all = make_judge();
    TestImage image = draw();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < strip; ++x)
            for (int c = 0; c < 3; ++c) std::swap(image.at(x, y, c), image.at(x + 3 * strip, y, c));
    const auto& sections = judge(all, image).pixel.beyond_by_section;
    EXPECT_GT(sections.at(0), 1000);
    EXPECT_GT(sections.at(3), 1000);
    EXPECT_EQ(sections.count(1) + sections.count(2), 0U);
}

TEST_F(Noisy, TheLastColumnIsMissing) {
    SeamJudge all = make_judge();
    TestImage image = draw();
    for (int y = 0; y < height; ++y)
        for (int c = 0; c < 3; ++c) image.at(width - 1, y, c) = 0;
    const Judgement found = judge(all, image);
    expect_pixels_in(found, {width - 1, 0, width, height});
    EXPECT_GT(found.pixel.beyond, height);
    EXPECT_EQ(found.pixel.beyond_near, 0);
}

TEST_F(Noisy, ASectionOnePixelOff) {
    SeamJudge all = make_judge();
    TestImage image = draw();
    for (int y = 0; y < height; ++y)
        for (int x = strip; x < 2 * strip; ++x)
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = scene_.at(x + 1, y, c);
    expect_pixels_in(judge(all, image), {strip, 0, 2 * strip, height});
}

TEST_F(Noisy, AnotherGammaInASection) {
    SeamJudge all = make_judge();
    TestImage image = draw();
    for (int y = 0; y < height; ++y)
        for (int x = 2 * strip; x < 3 * strip; ++x)
            for (int c = 0; c < 3; ++c) {
                double& value = image.at(x, y, c);
                value = std::round(255 * std::pow(value / 255, 1 / 2.2));
            }
    const Judgement found = judge(all, image);
    expect_pixels_in(found, {2 * strip, 0, 3 * strip, height});
    EXPECT_TRUE(found.step.alarm());
    EXPECT_THAT(found.step.at->line.position, testing::AnyOf(2 * strip, 3 * strip));
}

TEST_F(Noisy, ASectionOfAnotherCamera) {
    SeamJudge all = make_judge();
    TestImage image = draw();
    const TestImage other = textured(2 * width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 3 * strip; x < width; ++x)
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = TestImage(other).at(x + width, y, c);
    expect_pixels_in(judge(all, image), {3 * strip, 0, width, height});
}

TEST_F(Noisy, ABlurredSeam) {
    SeamJudge all = make_judge();
    TestImage image = draw();
    const TestImage sharp = image;
    for (int y = 0; y < height; ++y)
        for (int x = 2 * strip - 1; x <= 2 * strip; ++x)
            for (int c = 0; c < 3; ++c) {
                const auto at = [&](int column) {
                    return sharp.row(
                        y)[static_cast<std::size_t>(column) * 3 + static_cast<std::size_t>(c)];
                };
                image.at(x, y, c) = std::floor((at(x - 1) + 2 * at(x) + at(x + 1)) / 4);
            }
    const Judgement found = judge(all, image);
    expect_pixels_in(found, {2 * strip - 1, 0, 2 * strip + 1, height});
    EXPECT_EQ(found.pixel.beyond_near, found.pixel.beyond);
    EXPECT_EQ(found.pixel.at->seam_distance, 0);
}

TEST_F(Noisy, OneNaN) {
    SeamJudge all = make_judge(TypeDesc::HALF);
    TestImage image = draw();
    image.at(50, 60, 1) = std::numeric_limits<double>::quiet_NaN();
    const Judgement found = judge(all, image, TypeDesc::HALF);
    EXPECT_EQ(found.pixel.beyond, 1);
    EXPECT_EQ(found.pixel.at->x, 50);
    EXPECT_EQ(found.pixel.at->y, 60);
    EXPECT_EQ(found.pixel.at->channel, 1);
    EXPECT_TRUE(std::isinf(*found.pixel.largest));
}

TEST_F(Noisy, RoundingOfWhatNeverChangesIsNoDamage) {
    SeamJudge all = make_judge();
    TestImage image = draw();
    image.at(30, 5, 0) += 1;  // where no render has noise
    EXPECT_FALSE(judge(all, image).pixel.alarm());
    image.at(30, 5, 0) += 9;
    expect_pixels_in(judge(all, image), {30, 5, 31, 6});
}

// Its own reference differs from the renders by more than noise, and it goes with its reference.
TEST_F(Noisy, AnImageIsJudgedByItsOwnReference) {
    SeamJudge all = make_judge();
    TestImage reference = draw(), image = draw();
    for (int y = 0; y < height; ++y) {
        reference.at(strip, y, 0) = 250;
        image.at(strip, y, 0) = 250;
    }
    write_image(file("own", TypeDesc::UINT8), reference, TypeDesc::UINT8);
    write_image(file("image", TypeDesc::UINT8), image, TypeDesc::UINT8);
    const RunRecord run = run_of(width, height, Shape::columns, 4);
    const auto path = file("image", TypeDesc::UINT8);
    EXPECT_TRUE(all.judge({path, run, {}}).pixel.alarm());
    EXPECT_FALSE(all.judge({path, run, file("own", TypeDesc::UINT8)}).alarm());
}

TEST_F(Noisy, TooFewRendersAreRefused) {
    EXPECT_THROW(SeamJudge({"a.png", "b.png", "c.png"}), std::invalid_argument);
}

TEST(Decide, SaysWhatIsPromised) {
    VerdictRequest request;
    request.differing = 3;
    request.exact_scene = true;
    EXPECT_FALSE(decide(request).ok);
    EXPECT_EQ(decide(request).kind, Verdict::Kind::differs);
    for (const Seams seams : {Seams::plain, Seams::halo}) {
        request.seams = seams;
        request.sees_blocks = false;
        EXPECT_FALSE(decide(request).ok);
        request.sees_blocks = true;
        EXPECT_TRUE(decide(request).ok);
        request.worst_section_share = 0.5;
        EXPECT_FALSE(decide(request).ok) << "no antialiasing changes half of a section";
        request.worst_section_share = 0.05;
    }
    request.exact_scene = false;
    EXPECT_FALSE(decide(request).ok);
    request.judgement.emplace();
    EXPECT_EQ(decide(request).kind, Verdict::Kind::within_noise);
    request.judgement->pixel.beyond = 1;
    request.judgement->pixel.at.emplace();
    EXPECT_EQ(decide(request).kind, Verdict::Kind::beyond_noise);
    request.identical = true;
    EXPECT_TRUE(decide(request).ok);
}

}  // namespace
}  // namespace mpipov
