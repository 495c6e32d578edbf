#include "cost_source.h"

#include "cost_model.h"
#include "run_record.h"
#include "scratch.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

namespace mpipov {
namespace {

constexpr Rect small{0, 0, 64, 48}, large{0, 0, 640, 480};

// Of a run whose left half took three times as long as the right one.
RunRecord earlier_run(double left_cpu, double right_cpu) {
    RunRecord record;
    record.complete = true;
    record.scene_sha1 = "abc";
    record.plan.image = {small.width(), small.height(), 3, "png", "uint8"};
    record.plan.region = small;
    record.sections.resize(2);
    record.sections[0].section = {0, {0, 0, 32, 48}, {0, 0, 32, 48}};
    record.sections[0].cpu_seconds = left_cpu;
    record.sections[1].section = {1, {32, 0, 64, 48}, {32, 0, 64, 48}};
    record.sections[1].cpu_seconds = right_cpu;
    return record;
}

ProbeResult probe_of(const Rect& image, double render_cpu) {
    ProbeResult probe;
    probe.image.width = image.width();
    probe.image.height = image.height();
    probe.image.region = image;
    probe.probe_pixels = image.area();
    probe.report.trace_cpu = render_cpu;
    return probe;
}

class CostSourceTest : public testing::Test {
  protected:
    std::filesystem::path file() const { return scratch_.path() / "run.json"; }

  private:
    ScratchFolder scratch_{"cost-source-test"};
};

// The earlier run may have been a preview of low quality.
TEST_F(CostSourceTest, TheRecordTellsWhereAndTheProbeHowMuch) {
    const ProbeResult probe = probe_of(large, 100);
    const double launch = make_cost_model(probe_of(small, 0)).per_launch;
    write_run_record(file(), earlier_run(3 + launch, 1 + launch));
    const auto costs = costs_of_earlier_run(file(), "abc", probe);
    ASSERT_TRUE(costs);
    EXPECT_NEAR(costs->cpu_seconds(), 100, 1e-6);
    EXPECT_NEAR(costs->cpu_seconds({0, 0, 320, 480}), 75, 1e-6);
}

TEST_F(CostSourceTest, ARunThatTookNoTimeTellsNothing) {
    write_run_record(file(), earlier_run(0, 0));
    EXPECT_FALSE(costs_of_earlier_run(file(), "abc", probe_of(large, 100)));
}

TEST_F(CostSourceTest, ARunOfAnotherSceneTellsNothing) {
    write_run_record(file(), earlier_run(3, 1));
    EXPECT_FALSE(costs_of_earlier_run(file(), "def", probe_of(large, 100)));
    EXPECT_TRUE(costs_of_earlier_run(file(), "abc", probe_of(large, 100)));
}

// It would wait for ever.
TEST_F(CostSourceTest, APipeIsNotRead) {
    ASSERT_EQ(::mkfifo(file().c_str(), 0600), 0);
    EXPECT_FALSE(costs_of_earlier_run(file(), "abc", probe_of(large, 100)));
}

}  // namespace
}  // namespace mpipov
