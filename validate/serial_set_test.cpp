#include "serial_set.h"

#include <gtest/gtest.h>

namespace mpipov {
namespace {

TEST(SerialSet, ASceneWithHardlyAnyNoiseIsExact) {
    NoiseReport noise;
    EXPECT_FALSE(is_exact(noise));  // nothing is known
    noise.exact = true;
    EXPECT_TRUE(is_exact(noise));

    noise.exact = false;
    noise.floor.emplace();
    noise.floor->samples = 96768;
    noise.floor->noisy = 3;
    EXPECT_FALSE(is_exact(noise)) << "there are renders enough to judge by";
    noise.why_not = "only 1 of 40 other orders gave another image";
    EXPECT_TRUE(is_exact(noise));
    noise.floor->noisy = 97;
    EXPECT_FALSE(is_exact(noise));
}

}  // namespace
}  // namespace mpipov
