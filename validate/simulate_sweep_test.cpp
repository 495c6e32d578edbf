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

// 2 sections in 2 waves of one each, then the 2 of the image: 4 launches of 1 s, of which pretrace
// takes 0.25 s where there is no cache yet.
RunRecord gathered_run() {
    RunRecord record = one_run();
    PlanRecord& plan = record.plan;
    plan.radiosity = {Sharing::joined, 1, 1};
    plan.effects["radiosity"] = {true, "Radiosity Time is given", 0.25};
    plan.effects["order_dependent"].on = true;
    plan.predicted = {0, 2 * 10 + 4 * 1.0 - 2 * 0.25};
    for (int i = 0; i < 2; ++i) {
        SectionRecord one = record.sections[static_cast<std::size_t>(i)];
        one.section.id = 0;
        one.start = 0.5 + i * 0.5;
        one.cpu_seconds = 3 + i;
        record.waves.push_back({200, 100, 10, {one}});
    }
    return record;
}

TEST(SimulateCase, WavesAreTermsOfTheirOwn) {
    const SimulateCase what = case_of_run(gathered_run());
    EXPECT_NEAR(what.launch_cpu(), 0.75, 1e-9);
    EXPECT_NEAR(what.costs.cpu_seconds(), 5 + 6 - 2 * 0.75, 1e-9);
    EXPECT_FALSE(what.on(term::radiosity));
    ASSERT_EQ(what.waves.size(), 2U);
    EXPECT_NEAR(what.waves[0].at(0), 2.25, 1e-9);
    EXPECT_NEAR(what.value(term::gathering), 2.25 + 3.25, 1e-9);
    EXPECT_NEAR(what.value(term::before), 0.5, 1e-9);
}

TEST(SimulateSweep, WavesComeOneAfterTheOther) {
    SimulateCase what = case_of_run(gathered_run());
    for (const SimulateTerm& one : case_of_run(gathered_run()).terms)
        if (one.name != term::gathering && one.name != term::uneven)
            switch_off(what.terms, one.name, "not in this test");
    // One section each: a second rank has nothing to do in them.
    EXPECT_NEAR(gathering_seconds(what, 1, 1), 5.5, 1e-9);
    EXPECT_NEAR(gathering_seconds(what, 2, 1), 5.5, 1e-9);
    const double image = 5 + 6 - 1.5, longest = 6 - 0.75;
    EXPECT_NEAR(simulate(what, 1).wall_seconds, 5.5 + image, 1e-9);
    const SimulateRow two = simulate(what, 2);
    EXPECT_NEAR(two.wall_seconds, 5.5 + longest, 1e-9);
    EXPECT_EQ(two.bound_by, term::gathering);
    EXPECT_FALSE(law_of(what, two).empty());
    what.against = 7.0;
    EXPECT_NEAR(simulate(what, 2).speedup, 7.0 / two.wall_seconds, 1e-9);
}

TEST(SimulateCase, WavesOfAnEarlierRunAreMissing) {
    RunRecord record = gathered_run();
    while (!record.waves.empty()) {
        record.waves.pop_back();
        EXPECT_THROW(case_of_run(record), std::invalid_argument);
    }
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
