#include "radiosity_cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace mpipov {
namespace {

using testing::HasSubstr;

const std::string first =
    "C2\t31.0616\t0\t47.7735\t7ffe7f\t0.1489\t0.0983\t0.0275\t13.9321\t2.37604\ta19106\n";
const std::string second =
    "C12\t-1e-05\t54.88\t48.6211\t7f007f\t0.2908\t0.1487\t0.0449\t15.2693\t5.74339\tf86463\n";

TEST(RadiosityCache, JoinsFilesLineByLineInTheirOrder) {
    RadiosityCache cache;
    EXPECT_TRUE(cache.empty());
    cache.add(second);
    cache.add(first);
    EXPECT_EQ(cache.text(), second + first);
    EXPECT_EQ(cache.samples(), 2);
}

TEST(RadiosityCache, TakesEachSampleOnce) {
    RadiosityCache cache;
    cache.add(first + second);
    cache.add(first + first + second);
    EXPECT_EQ(cache.text(), first + second);
    EXPECT_EQ(cache.samples(), 2);
}

TEST(RadiosityCache, NothingIsNoSample) {
    RadiosityCache cache;
    cache.add("");
    EXPECT_TRUE(cache.empty());
}

TEST(RadiosityCache, ADamagedFileAddsNothing) {
    const std::string cut = first.substr(0, first.size() - 4), zeros(40, '\0');
    for (const std::string& text : {second + cut, second + cut + "\n" + cut, "P6\n" + second,
                                    second + zeros + "\n", "C2\t1\t2\n" + second, second + "\n",
                                    "C\t" + first.substr(3), "C2\t<script>" + first.substr(10)}) {
        RadiosityCache cache;
        cache.add(first);
        EXPECT_THROW(cache.add(text), std::runtime_error) << text;
        EXPECT_EQ(cache.text(), first);
    }
}

TEST(RadiosityCache, TheErrorShowsTheLine) {
    try {
        RadiosityCache().add("no sample at all\n");
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("'no sample at all'"));
    }
}

}  // namespace
}  // namespace mpipov
