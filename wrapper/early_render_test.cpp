#include "early_render.h"

#include "scratch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace mpipov {
namespace {

class EarlyRenderTest : public testing::Test {
  protected:
    bool starts(const std::function<void(JobSetup&)>& change, int ranks = 2) {
        JobSetup setup;
        setup.options.povray = "true";
        setup.pool0 = 2;
        setup.ranks_of_host = 2;
        change(setup);
        const auto early = start_early(setup, ranks, {"scene.pov"}, scratch_.path() / "early", {});
        return early.has_value();
    }
    ScratchFolder scratch_{"early-test"};
};

TEST_F(EarlyRenderTest, StartsWhereOneLaunchCouldBeThePlan) {
    EXPECT_TRUE(starts([](JobSetup&) {}));
    EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "early")) << "nobody took it";
}

TEST_F(EarlyRenderTest, DoesNotWhereTheOptionsRuleItOut) {
    EXPECT_FALSE(starts([](JobSetup& s) { s.options.dry_run = true; }));
    EXPECT_FALSE(starts([](JobSetup& s) { s.options.resume = true; }));
    EXPECT_FALSE(starts([](JobSetup& s) { s.options.dedicated_coordinator = true; }));
    EXPECT_FALSE(starts([](JobSetup& s) { s.options.schedule = Policy::static_; }));
    EXPECT_FALSE(starts([](JobSetup& s) { s.options.sections = 2; }));
    EXPECT_FALSE(starts([](JobSetup& s) { s.options.seams = Seams::halo; }));
    EXPECT_FALSE(starts([](JobSetup&) {}, 3)) << "another host has cores too";
}

}  // namespace
}  // namespace mpipov
