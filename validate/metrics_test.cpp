#include "metrics.h"

#include "test_image.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <gmock/gmock.h>

#include <limits>

namespace mpipov {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Sum, KeepsWhatADoubleLoses) {
    // 2^53 + 1 is no double: added one by one to a plain double, the ones would all be lost.
    Sum sum;
    sum.add(9007199254740992.0);
    for (int i = 0; i < 1000; ++i) sum.add(1);
    sum.add(-9007199254740992.0);
    EXPECT_EQ(sum.value(), 1000);
}

TEST(Sum, SquaresOf16BitsStayExactPastTheRangeOfSixtyFourBits) {
    // Three blocks of 2^31 worst-case squares, which is more than 2^64, and then one level.
    const double block = 65535.0 * 65535.0 * 2147483648.0;
    Sum sum;
    for (int i = 0; i < 3; ++i) sum.add(block);
    sum.add(1);
    for (int i = 0; i < 3; ++i) sum.add(-block);
    EXPECT_EQ(sum.value(), 1);
}

TEST(ErrorSums, CountsPastTwoToThe31) {
    ErrorSums errors;
    errors.add_equal(3'000'000'000);
    errors.add(0, 3);
    EXPECT_EQ(errors.samples(), 3'000'000'001);
    EXPECT_DOUBLE_EQ(*errors.mean_abs(), 3 / 3000000001.0);
    EXPECT_EQ(*errors.max(), 3);
}

TEST(ErrorSums, NothingIsUndefined) {
    const ErrorSums none;
    EXPECT_FALSE(none.mean_abs());
    EXPECT_FALSE(none.rms());
    EXPECT_FALSE(none.max());
}

TEST(Metrics, TheSignOfZeroIsADifferenceWithoutAnError) {
    TestImage a = textured(20, 10), b = a;
    a.at(3, 4, 1) = 0.0;
    b.at(3, 4, 1) = -0.0;
    const Metrics metrics = measure(a, b);
    EXPECT_FALSE(metrics.identical());
    EXPECT_EQ(metrics.counts.differing, 1);
    EXPECT_EQ(metrics.differing_box, (Rect{3, 4, 4, 5}));
    EXPECT_EQ(metrics.zero_signs, 1);
    EXPECT_EQ(metrics.all.samples(), 600);
    EXPECT_EQ(metrics.all.max(), 0);
    EXPECT_FALSE(metrics.largest);
    EXPECT_FALSE(metrics.psnr(255));
    EXPECT_EQ(measure(b, b).zero_signs, 0);
    EXPECT_TRUE(measure(b, b).identical());
}

TEST(Metrics, OfIdenticalImages) {
    const TestImage a = textured(20, 10);
    const Metrics metrics = measure(a, a);
    EXPECT_TRUE(metrics.identical());
    EXPECT_EQ(metrics.counts.pixels, 200);
    EXPECT_EQ(metrics.all.samples(), 600);
    EXPECT_EQ(metrics.all.rms(), 0);
    EXPECT_FALSE(metrics.psnr(255));
    EXPECT_FALSE(metrics.largest);
    EXPECT_TRUE(metrics.differing_box.empty());
}

TEST(Metrics, OfBlackImages) {
    const TestImage a{4, 3, 3, std::vector<double>(36)};
    const Metrics metrics = measure(a, a);
    EXPECT_TRUE(metrics.identical());
    EXPECT_EQ(metrics.all.mean_abs(), 0);
}

TEST(Metrics, ByHand) {
    TestImage a{2, 2, 1, {10, 20, 30, 40}};
    TestImage b{2, 2, 1, {10, 23, 26, 40}};
    const Metrics metrics = measure(a, b);
    EXPECT_EQ(metrics.counts.differing, 2);
    EXPECT_EQ(metrics.differing_box, (Rect{0, 0, 2, 2}));
    EXPECT_DOUBLE_EQ(*metrics.all.mean_abs(), 7 / 4.0);
    EXPECT_DOUBLE_EQ(*metrics.all.mean_signed(), -1 / 4.0);
    EXPECT_DOUBLE_EQ(*metrics.all.rms(), 2.5);
    EXPECT_DOUBLE_EQ(*metrics.psnr(255), 20 * std::log10(255 / 2.5));
    ASSERT_TRUE(metrics.largest);
    EXPECT_EQ(metrics.largest->x, 0);
    EXPECT_EQ(metrics.largest->y, 1);
    EXPECT_EQ(metrics.largest->a, 30);
    EXPECT_EQ(metrics.largest->b, 26);
}

TEST(Metrics, FirstInReadingOrderOfSeveralEquallyLarge) {
    const TestImage a = textured(9, 9);
    TestImage b = a;
    b.at(7, 2, 0) += 5;
    b.at(3, 5, 1) -= 5;
    b.at(3, 2, 2) -= 5;
    const Metrics metrics = measure(a, b);
    EXPECT_EQ(metrics.largest->x, 3);
    EXPECT_EQ(metrics.largest->y, 2);
    EXPECT_EQ(metrics.largest->channel, 2);
    EXPECT_EQ(metrics.differing_box, (Rect{3, 2, 8, 6}));
    EXPECT_EQ(metrics.channels[0].max(), 5);
    EXPECT_EQ(metrics.channels[1].mean_signed(), -5 / 81.0);
}

TEST(Metrics, AgreeWithOpenImageIO) {
    const TestImage a = textured(61, 47);
    TestImage b = textured(61, 47);
    for (std::size_t i = 0; i < b.values.size(); i += 7)
        b.values[i] = 250 - b.values[i] / 2 - static_cast<double>(i % 5);
    const OIIO::ImageSpec spec(61, 47, 3, OIIO::TypeDesc::DOUBLE);
    std::vector<double> p = a.values, q = b.values;
    for (std::vector<double>* values : {&p, &q})
        for (double& value : *values) value /= 255;
    const OIIO::ImageBuf buffer_a(spec, p.data()), buffer_b(spec, q.data());
    const auto theirs = OIIO::ImageBufAlgo::compare(buffer_a, buffer_b, 0, 0);
    const Metrics ours = measure(a, b);
    EXPECT_NEAR(*ours.all.mean_abs() / 255, theirs.meanerror, 1e-7);
    EXPECT_NEAR(*ours.all.rms() / 255, theirs.rms_error, 1e-7);
    EXPECT_NEAR(*ours.psnr(255), theirs.PSNR, 1e-4);
    EXPECT_NEAR(*ours.all.max() / 255, theirs.maxerror, 1e-7);
    EXPECT_EQ(ours.largest->x, theirs.maxx);
    EXPECT_EQ(ours.largest->y, theirs.maxy);
    EXPECT_EQ(ours.largest->channel, theirs.maxc);
    EXPECT_EQ(ours.counts.differing, static_cast<long long>(theirs.nfail));
}

TEST(Metrics, NaNInOneImageIsADifferenceButNoError) {
    const TestImage a = textured(8, 4);
    TestImage b = a;
    b.at(5, 2, 1) = nan;
    const Metrics metrics = measure(a, b);
    EXPECT_FALSE(metrics.identical());
    EXPECT_EQ(metrics.counts.differing, 1);
    EXPECT_EQ(metrics.differing_box, (Rect{5, 2, 6, 3}));
    EXPECT_EQ(metrics.all.rms(), 0);
    EXPECT_EQ(metrics.all.samples(), 8 * 4 * 3 - 1);
    EXPECT_FALSE(metrics.largest);
    EXPECT_EQ(metrics.nonfinite.nan_b, 1);
    EXPECT_EQ(metrics.nonfinite.mismatches, 1);
    ASSERT_EQ(metrics.nonfinite.first.size(), 1U);
    const NonFinitePlace& place = metrics.nonfinite.first.front();
    EXPECT_EQ(place.image, 'b');
    EXPECT_EQ(place.x, 5);
    EXPECT_EQ(place.y, 2);
    EXPECT_EQ(place.channel, 1);
}

TEST(Metrics, NaNInBothImagesIsEqualAndInfinitiesByTheirSign) {
    TestImage a = textured(8, 4);
    TestImage b = a;
    a.at(1, 1, 0) = b.at(1, 1, 0) = nan;
    a.at(2, 1, 0) = b.at(2, 1, 0) = infinity;
    EXPECT_TRUE(measure(a, b).identical());
    EXPECT_EQ(measure(a, b).nonfinite.total(), 4);
    EXPECT_EQ(measure(a, b).all.samples(), 8 * 4 * 3 - 2);
    b.at(2, 1, 0) = -infinity;
    EXPECT_EQ(measure(a, b).counts.differing, 1);
    EXPECT_EQ(measure(a, b).nonfinite.mismatches, 1);
}

TEST(Metrics, NamesTheFirstPlacesOnly) {
    const TestImage a = textured(30, 4);
    TestImage b = a;
    for (int x = 0; x < 30; ++x) b.at(x, 3, 0) = nan;
    const Metrics metrics = measure(a, b);
    EXPECT_EQ(metrics.nonfinite.nan_b, 30);
    EXPECT_EQ(metrics.nonfinite.first.size(), NonFinite::places_kept);
}

}  // namespace
}  // namespace mpipov
