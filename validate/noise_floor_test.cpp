#include "noise_floor.h"

#include "noise_variants.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <set>

namespace mpipov {
namespace {

TEST(NoiseFloor, SigmaIsTheRootOfTheMeanVariance) {
    NoiseFloorBuilder builder({2, 1, 2});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<double> a{10, 20, 30, nan}, b{12, 20, 30, 1};
    const std::vector<std::span<const double>> rows{a, b};
    builder.add_row(0, rows);
    const NoiseFloor floor = builder.result();
    EXPECT_EQ(floor.renders, 2);
    EXPECT_EQ(floor.samples, 3);
    EXPECT_EQ(floor.noisy, 1);
    EXPECT_NEAR(*floor.sigma, std::sqrt(2.0 / 3), 1e-12);
    EXPECT_NEAR(floor.largest_sigma, std::sqrt(2.0), 1e-12);
    EXPECT_EQ(floor.x, 0);
    EXPECT_EQ(floor.channel, 0);
}

TEST(Quantisation, LevelsAreOneAndFloatsRelative) {
    EXPECT_DOUBLE_EQ((Quantisation{Quantisation::Kind::levels}.variance(200, 200)), 1.0 / 12);
    EXPECT_DOUBLE_EQ((Quantisation{Quantisation::Kind::half}.step(0.5, 1)), 0x1p-11);
    EXPECT_DOUBLE_EQ((Quantisation{Quantisation::Kind::shared_exponent}.step(0.01, 1)), 0x1p-7);
}

TEST(NoiseVariants, DifferAndKeepTheBlocksWhereTheyMust) {
    std::set<std::vector<std::string>> seen;
    std::set<std::string> names;
    for (int i = 0; i < 60; ++i) {
        const NoiseVariant variant = noise_variant(i, true);
        EXPECT_TRUE(seen.insert(variant.arguments).second) << i;
        EXPECT_TRUE(names.insert(variant.name).second) << i;
        for (const std::string& argument : variant.arguments)
            EXPECT_NE(argument.rfind("+BS", 0), 0U) << i;
    }
    EXPECT_THAT(noise_variant(9, false).arguments, testing::Contains(testing::StartsWith("+BS")));
}

}  // namespace
}  // namespace mpipov
