#include "cost_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mpipov {
namespace {

// Of one scene, rendered with +A0.3 +AM1 at 30 x 22 and 480 x 360 pixels: samples for each pixel of
// the small image, and CPU microseconds for each pixel of both.
struct Measured {
    const char* scene;
    double samples, small_us, large_us;
};

constexpr int small_width = 30, small_height = 22, width = 480, height = 360;
constexpr Measured measured[] = {
    {"corner", 2.26, 645, 129}, {"checker", 8.99, 29, 13},     {"spheres", 4.92, 5, 1},
    {"demo", 6.07, 62, 19},     {"chess2", 6.18, 1432, 281},   {"woodbox", 4.06, 23, 8},
    {"teapot", 5.33, 17, 7},    {"isosurfaces", 4.51, 32, 12},
};

ProbeResult probe_of(const Measured& scene) {
    constexpr double pixels = small_width * small_height;
    ProbeResult probe;
    probe.image.width = width;
    probe.image.height = height;
    probe.image.region = {0, 0, width, height};
    probe.probe_pixels = small_width * small_height;
    probe.report.trace_cpu = 1e-6 * scene.small_us * pixels;
    // Method 1 renders the edges of its blocks, of 8 pixels here, twice.
    probe.report.counters["Pixels"] = std::llround(1.27 * pixels);
    probe.report.counters["Samples"] = std::llround(scene.samples * pixels);
    return probe;
}

double times_too_much(double said, double truth) {
    return std::max(said / truth, truth / said);
}

TEST(CostModel, AntialiasingTakesLessOfALargeImage) {
    double worst = 1, worst_by_area = 1;
    for (const Measured& scene : measured) {
        SCOPED_TRACE(scene.scene);
        ProbeResult probe = probe_of(scene);
        const double truth = 1e-6 * scene.large_us * width * height;
        const double said = times_too_much(make_cost_model(probe).render, truth);
        EXPECT_LT(said, 2.3);
        worst = std::max(worst, said);
        probe.report.counters.clear();
        worst_by_area =
            std::max(worst_by_area, times_too_much(make_cost_model(probe).render, truth));
    }
    EXPECT_GT(worst_by_area, 2 * worst) << "then why look at the samples";
}

TEST(CostModel, WithoutAntialiasingAreaIsAll) {
    ProbeResult probe = probe_of(measured[0]);
    probe.report.counters["Samples"] = 0;
    const double factor = 1.0 * width * height / (small_width * small_height);
    EXPECT_DOUBLE_EQ(make_cost_model(probe).render, probe.report.trace_cpu * factor);
}

TEST(CostModel, TheMiddleOfAPictureInItsOwnSizeIsAsAllOfIt) {
    ProbeResult probe = probe_of(measured[0]);
    probe.seen_whole = false;
    const double factor = 1.0 * width * height / (small_width * small_height);
    EXPECT_DOUBLE_EQ(make_cost_model(probe).render, probe.report.trace_cpu * factor);
}

TEST(CostModel, AddsUp) {
    ProbeResult probe;
    probe.image.width = probe.image.height = 1000;
    probe.image.region = {0, 0, 1000, 1000};
    probe.probe_pixels = 1000;
    probe.report.trace_cpu = 0.1;
    probe.report.parse_cpu = 1;
    const CostModel cost = make_cost_model(probe);
    EXPECT_NEAR(cost.render, 100, 1e-9);
    EXPECT_NEAR(cost.per_launch, 1 + 0.06 + 0.07, 1e-9);
    EXPECT_NEAR(cost.cpu_seconds(10), 100 + 10 * cost.per_launch, 1e-9);
    EXPECT_GT(cost.wall_seconds(10, 1, 1), cost.cpu_seconds(10));
    EXPECT_LT(cost.wall_seconds(10, 10, 1), cost.wall_seconds(10, 1, 1));
}

}  // namespace
}  // namespace mpipov
