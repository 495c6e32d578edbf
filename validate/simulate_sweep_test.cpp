#include "simulate_sweep.h"

#include <gmock/gmock.h>

#include <stdexcept>

namespace mpipov {
namespace {

using testing::HasSubstr;

SimulateCase even_case(double trace) {
    SimulateCase what;
    what.width = what.height = 1024;
    what.grid.region = {0, 0, 1024, 1024};
    what.costs = uniform_costs(what.grid.region, trace);
    what.terms = default_terms(1024, 1024);
    for (const SimulateTerm& one : default_terms(1024, 1024))
        if (one.name != term::uneven) switch_off(what.terms, one.name, "not in this test");
    return what;
}

TEST(SimulateSweep, WithoutTermsNothingIsLost) {
    const SimulateRow row = simulate(even_case(100), 16);
    EXPECT_NEAR(row.speedup, 16, 1e-6);
    EXPECT_NEAR(row.efficiency, 1, 1e-6);
    EXPECT_EQ(row.bound_by, "cores");
    EXPECT_EQ(row.cores, 16);
}

TEST(SimulateSweep, NamesTheTermInTheWay) {
    // Ten seconds for each of ten ranks, and a term of one second.
    for (const char* name : {term::before, term::after, term::start, term::frame}) {
        SimulateCase what = even_case(128);
        set_term(what.terms, name, 1, "this test");
        const SimulateRow row = simulate(what, 16);
        EXPECT_EQ(row.bound_by, name);
        EXPECT_NEAR(row.wall_seconds, 9, 0.01) << name;
        ASSERT_FALSE(row.without.empty());
        EXPECT_NEAR(row.without.front().wall_seconds, 8, 0.01) << name;
        EXPECT_THAT(law_of(what, row), HasSubstr("= 0.889"));
        // Serial starts and writes a frame too, but waits for no probe.
        const bool of_launch = name == term::start || name == term::frame;
        EXPECT_NEAR(row.speedup, (of_launch ? 129.0 : 128.0) / 9, 0.01) << name;
    }
}

TEST(SimulateSweep, TermsAreTakenAwayOneByOne) {
    SimulateCase what = even_case(128);
    set_term(what.terms, term::before, 2, "this test");
    set_term(what.terms, term::after, 1, "this test");
    const SimulateRow row = simulate(what, 16);
    EXPECT_EQ(row.one_by_one.at(0).term, term::before);
    EXPECT_NEAR(row.one_by_one.at(0).wall_seconds, 9, 1e-6);
    EXPECT_EQ(row.one_by_one.at(1).term, term::after);
    EXPECT_NEAR(row.one_by_one.at(1).wall_seconds, 8, 1e-6);
}

TEST(SimulateSweep, ASlowCoordinatorIsNamed) {
    SimulateCase what = even_case(10);
    what.sections = 1024;
    set_term(what.terms, term::service, 0.1, "this test");
    const SimulateRow row = simulate(what, 64);
    EXPECT_EQ(row.bound_by, term::service);
    EXPECT_NEAR(row.wall_seconds, 102.4, 0.1);
    EXPECT_THAT(law_of(what, row), HasSubstr("at most 10 sections a second"));
}

TEST(SimulateSweep, MoreSectionsWhereTheyCostDifferently) {
    SimulateCase what = even_case(0);
    what.costs = hill_costs(what.grid.region, 256);
    what.sections = 8;
    what.auto_shape = false;
    what.grid.shape = Shape::columns;
    EXPECT_EQ(simulate(what, 8).bound_by, term::uneven);
    what.sections.reset();
    what.auto_shape = true;
    const SimulateRow found = simulate(what, 8);
    EXPECT_GT(found.sections, 8);
    EXPECT_GT(found.efficiency, 0.98);
    what.policy = Policy::static_;
    EXPECT_EQ(simulate(what, 8).sections, 8);
}

TEST(SimulateSweep, PowerCountsWhatIsThereEvenIfItRendersNothing) {
    SimulateCase what = even_case(90);
    what.dedicated = true;
    SimulateRow row = simulate(what, 10);
    EXPECT_NEAR(row.efficiency, 0.9, 0.005);
    EXPECT_THROW(simulate(what, 1), std::invalid_argument);
    what.dedicated = false;
    what.slots = 2;
    what.speeds = {1, 0.5};
    row = simulate(what, 4);
    EXPECT_EQ(row.cores, 8);
    EXPECT_DOUBLE_EQ(row.power, 6);
}

TEST(SimulateSweep, NoMoreSectionsThanTheGridHolds) {
    const SimulateCase what = even_case(1);
    EXPECT_EQ(most_sections(what), 32 * 32);
    EXPECT_EQ(simulate(what, 5000).sections, 1024);
    SimulateCase too_many = what;
    too_many.sections = 1025;
    EXPECT_THROW(simulate(too_many, 2), std::invalid_argument);
}

RunRecord one_run() {
    RunRecord record;
    record.complete = true;
    PlanRecord& plan = record.plan;
    plan.image = {200, 100, 4, "png", "uint16"};
    plan.region = {0, 0, 200, 100};
    plan.seams = Seams::plain;
    plan.sections = 2;
    plan.effects["render"] = {true, "", 10.0};
    plan.effects["photons"] = {true, "Photon Time is given", 0.5};
    plan.effects["radiosity"] = {false, "No radiosity", {}};
    plan.effects["order_dependent"] = {false, "", {}};
    plan.predicted = {0, 10 + 2 * 1.0};
    for (int i = 0; i < 2; ++i) {
        SectionRecord one;
        one.section = {i, {100 * i, 0, 100 * i + 100, 100}, {100 * i, 0, 100 * i + 100, 100}};
        one.start = 1.5 + i;
        one.end = 9 + i;
        one.cpu_seconds = 5 + i;
        one.wall_seconds = 5.6 + i;
        record.sections.push_back(one);
    }
    record.totals.wall_seconds = 11;
    return record;
}

TEST(SimulateCase, TermsComeFromTheRecord) {
    const SimulateCase what = case_of_run(one_run());
    EXPECT_NEAR(what.costs.cpu_seconds(), 4 + 5, 1e-9);
    EXPECT_NEAR(what.launch_cpu(), 1, 1e-9);
    EXPECT_NEAR(what.value(term::photons), 0.5, 1e-9);
    EXPECT_NEAR(what.value(term::frame), 70e-9 * 20000, 1e-12);
    EXPECT_NEAR(what.value(term::start), 0.6, 1e-9);
    EXPECT_NEAR(what.value(term::before), 1.5, 1e-9);
    EXPECT_NEAR(what.value(term::after), 1, 1e-9);
    EXPECT_FALSE(what.on(term::radiosity));
    EXPECT_EQ(what.bytes_per_pixel, 8);
    EXPECT_FALSE(what.sections);
    EXPECT_NEAR(what.serial_seconds(), 0.6 + 1 + 9, 1e-9);
}

TEST(SimulateCase, ALaunchCostsNoMoreThanTheCheapestSection) {
    RunRecord record = one_run();
    record.sections[0].cpu_seconds = 0.25;
    record.sections[0].wall_seconds = 1;
    const SimulateCase what = case_of_run(record);
    EXPECT_NEAR(what.launch_cpu(), 0.25, 1e-9);
    EXPECT_NEAR(what.costs.cpu_seconds(), 5.75, 1e-9);
}

TEST(SimulateCase, APinnedGridStays) {
    RunRecord record = one_run();
    record.plan.effects["order_dependent"].on = true;
    EXPECT_EQ(case_of_run(record).sections, 2);
}

TEST(SimulateCase, ARecordThatIsNoWholeRunIsRefused) {
    RunRecord record = one_run();
    record.sections[1].resumed = true;
    EXPECT_THROW(case_of_run(record), std::invalid_argument);
    record = one_run();
    record.complete = false;
    EXPECT_THROW(case_of_run(record), std::invalid_argument);
    record = one_run();
    record.sections.clear();
    EXPECT_THROW(case_of_run(record), std::invalid_argument);
}

}  // namespace
}  // namespace mpipov
