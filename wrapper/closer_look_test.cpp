#include "closer_look.h"

#include "scratch.h"

#include <gtest/gtest.h>

#include <functional>

namespace mpipov {
namespace {

// How many launches it makes; each fails, since there is no such POV-Ray.
int launches(double predicted_seconds, const std::function<void(Options&)>& change) {
    const ScratchFolder scratch("closer-look-test");
    JobSetup setup;
    setup.options.povray = "/no/such/povray";
    change(setup.options);
    ProbeResult probe;
    probe.image.width = probe.image.height = 512;
    probe.image.region = {0, 0, 512, 512};
    probe.probe_pixels = 32 * 32;
    PlanRecord plan;
    plan.predicted.wall_seconds = predicted_seconds;
    Totals totals;
    look_closer(
        setup, {setup.options.povray, {"scene.pov", "+W512", "+H512"}, scratch.path() / "look", {}},
        probe, plan, totals);
    EXPECT_FALSE(probe.look);
    EXPECT_EQ(plan.effects.empty(), totals.launches == 0);
    return totals.launches;
}

TEST(CloserLook, IsTakenWhereItIsAskedForOrHardlyNoticed) {
    const auto nothing = [](Options&) {};
    EXPECT_EQ(launches(1, nothing), 0);
    EXPECT_EQ(launches(1000, nothing), 4) << "the probe's own render is the fifth";
    EXPECT_EQ(launches(1, [](Options& o) { o.dry_run = true; }), 6) << "in a larger picture";
    EXPECT_EQ(launches(1000, [](Options& o) { o.resume = true; }), 0);
}

}  // namespace
}  // namespace mpipov
