#include "tradeoff_settings.h"

#include "failure.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

namespace mpipov {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

std::vector<std::string> names_of(const TradeoffPlan& plan, Sweep sweep) {
    std::vector<std::string> names;
    for (const TradeoffSetting& setting : plan.settings)
        if (setting.sweep == sweep) names.push_back(setting.name);
    return names;
}

const TradeoffSetting& setting(const TradeoffPlan& plan, const std::string& name) {
    return *std::find_if(plan.settings.begin(), plan.settings.end(),
                         [&](const TradeoffSetting& one) { return one.name == name; });
}

TradeoffChoice only(Sweep sweep) {
    TradeoffChoice choice;
    choice.sweeps = {sweep};
    return choice;
}

TEST(TradeoffSettings, AntialiasingChangesOneThingAtATime) {
    TradeoffChoice choice = only(Sweep::antialiasing);
    choice.methods = {2};
    const TradeoffPlan plan = plan_tradeoff(choice, {});
    EXPECT_THAT(names_of(plan, Sweep::antialiasing),
                ElementsAre("aa-off", "aa-m2-d1-t0.1", "aa-m2-d2-t0.1", "aa-m2-d3-t0.1",
                            "aa-m2-d4-t0.1", "aa-m2-d5-t0.1", "aa-m2-d3-t0.3", "aa-m2-d3-t0.03",
                            "aa-m2-d3-t0.01", "aa-m2-d5-t0.01"));
    EXPECT_THAT(setting(plan, "aa-off").arguments, ElementsAre("-A"));
    EXPECT_THAT(setting(plan, "aa-m2-d5-t0.01").arguments, ElementsAre("+A0.01", "+AM2", "+R5"));
    EXPECT_FALSE(setting(plan, "aa-m2-d5-t0.01").mpipov);
    EXPECT_EQ(setting(plan, "aa-off").serial, "");
}

TEST(TradeoffSettings, SectionsKeepTheUsersAntialiasing) {
    SceneCalls scene;
    scene.antialiasing = {true, 1, 3, 0.2};
    scene.longest_side = 320;
    const TradeoffPlan plan = plan_tradeoff(only(Sweep::decomposition), scene);
    EXPECT_THAT(plan.base_antialiasing, IsEmpty());
    EXPECT_THAT(names_of(plan, Sweep::decomposition),
                ElementsAre("serial", "aligned-g2", "aligned-g4", "aligned-g8", "aligned-g16",
                            "aligned-g32", "aligned-g64", "plain-g8", "serial-oneblock", "halo1-g8",
                            "halo2-g8", "halo4-g8", "halo8-g8"));
    EXPECT_THAT(setting(plan, "aligned-g2").arguments, IsEmpty());
    EXPECT_THAT(setting(plan, "serial-oneblock").arguments, ElementsAre("+BS320"));
    EXPECT_EQ(setting(plan, "halo4-g8").serial, "serial-oneblock");
    EXPECT_EQ(setting(plan, "plain-g8").serial, "serial");
    EXPECT_THAT(setting(plan, "halo4-g8").options, Contains("halo:4"));
    EXPECT_TRUE(setting(plan, "halo4-g8").mpipov);
}

TEST(TradeoffSettings, WithoutAntialiasingSectionsGetTheDefault) {
    const TradeoffPlan plan = plan_tradeoff(only(Sweep::decomposition), {});
    EXPECT_THAT(plan.base_antialiasing, ElementsAre("+A0.3", "+AM1", "+R3"));
    EXPECT_EQ(setting(plan, "serial").arguments, plan.base_antialiasing);
    EXPECT_EQ(setting(plan, "aligned-g8").arguments, plan.base_antialiasing);
    EXPECT_THAT(setting(plan, "serial-oneblock").arguments, SizeIs(4));
}

TEST(TradeoffSettings, Method2KnowsNoSeams) {
    SceneCalls scene;
    scene.antialiasing = {true, 2, 3, 0.2};
    const TradeoffPlan plan = plan_tradeoff(only(Sweep::decomposition), scene);
    EXPECT_THAT(names_of(plan, Sweep::decomposition),
                ElementsAre("serial", "plain-g2", "plain-g4", "plain-g8", "plain-g16", "plain-g32",
                            "plain-g64"));
    ASSERT_THAT(plan.left_out, SizeIs(1));
    EXPECT_THAT(plan.left_out[0].why, HasSubstr("method 2"));
}

TEST(TradeoffSettings, OnlyWhatTheSceneCallsFor) {
    TradeoffChoice choice;
    choice.radiosity = {"independent", "shared:1/4"};
    SceneCalls plain;
    const TradeoffPlan without = plan_tradeoff(choice, plain);
    EXPECT_THAT(names_of(without, Sweep::radiosity), IsEmpty());
    EXPECT_THAT(names_of(without, Sweep::threads), ElementsAre("threads-1", "threads-2"));

    SceneCalls calls;
    calls.radiosity = calls.order_dependent = true;
    const TradeoffPlan with = plan_tradeoff(choice, calls);
    EXPECT_THAT(names_of(with, Sweep::radiosity),
                ElementsAre("radiosity-independent", "radiosity-shared-1-scale-4"));
    const TradeoffSetting& scaled = setting(with, "radiosity-shared-1-scale-4");
    EXPECT_EQ(std::vector(scaled.options.end() - 4, scaled.options.end()),
              (std::vector<std::string>{"--radiosity", "shared:1", "--radiosity-scale", "4"}));
    EXPECT_THAT(setting(with, "radiosity-independent").options, Not(Contains("--radiosity-scale")));
    EXPECT_THAT(names_of(with, Sweep::threads), IsEmpty());
    EXPECT_THAT(with.left_out.back().why, HasSubstr("another each time"));
}

TEST(TradeoffSettings, NamesAreUnique) {
    SceneCalls calls;
    calls.radiosity = true;
    const TradeoffPlan plan = plan_tradeoff({}, calls);
    std::set<std::string> names;
    for (const TradeoffSetting& one : plan.settings)
        EXPECT_TRUE(names.insert(one.name).second) << one.name;
}

TEST(TradeoffSettings, NothingToSweepIsAnError) {
    try {
        plan_tradeoff(only(Sweep::radiosity), {});
        FAIL();
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), Exit::usage);
        EXPECT_THAT(failure.what(), HasSubstr("the scene has no radiosity"));
    }
}

TEST(Middle, OfAnEvenNumberTheFirstOfTheTwo) {
    EXPECT_EQ(middle(std::vector<int>{1, 2, 3, 4, 5}), 3);
    EXPECT_EQ(middle(std::vector<int>{1, 2, 3, 4}), 2);
    EXPECT_EQ(middle(std::vector<int>{7}), 7);
}

}  // namespace
}  // namespace mpipov
