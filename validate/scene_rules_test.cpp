#include "scene_rules.h"

#include "scratch.h"
#include "speedup_variants.h"
#include "tradeoff_renders.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <gmock/gmock.h>

#include <fstream>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsSupersetOf;

SceneRules parsed(std::vector<std::string> arguments) {
    SceneRules rules;
    CLI::App app;
    add_scene_rules(app, rules);
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants a vector
    app.parse(arguments);
    return rules;
}

const std::vector<std::string> all_of_them{
    "--allow-read",   "a",  "--allow-read=b",   "--allow-write", "c", "--confine", "off",
    "--memory-limit", "2G", "--disk-limit=none"};

TEST(SceneRules, MpipovUnderstandsWhatItIsGiven) {
    const SceneRules rules = parsed(all_of_them);
    std::vector<std::string> arguments = rules.given;
    arguments.emplace_back("scene.pov");
    const Options mpipovs = parse_options(arguments);
    for (const Options* options : {&rules.options, &mpipovs}) {
        EXPECT_THAT(options->allow_read, ElementsAre("a", "b"));
        EXPECT_THAT(options->allow_write, ElementsAre("c"));
        EXPECT_EQ(options->confine, Confining::off);
        EXPECT_EQ(options->memory_limit.bytes, std::uint64_t{2} << 30);
        EXPECT_FALSE(options->disk_limit.automatic);
        EXPECT_FALSE(options->disk_limit.bytes);
    }
    EXPECT_THAT(mpipovs.povray_arguments, ElementsAre("scene.pov"));
}

TEST(SceneRules, NothingIsHandedOnThatWasNotGiven) {
    const SceneRules rules = parsed({});
    EXPECT_TRUE(rules.given.empty());
    EXPECT_EQ(rules.options.confine, Confining::automatic);
}

TEST(SceneRules, OnlyTheOptionsOfThatGroupAreTaken) {
    EXPECT_THROW(parsed({"--sections", "2"}), CLI::ParseError);
    EXPECT_THROW(parsed({"--retries", "2"}), CLI::ParseError);
}

TEST(SceneRules, AWrongValueNamesItsOption) {
    try {
        parsed({"--confine", "maybe"});
        ADD_FAILURE() << "it was taken";
    } catch (const CLI::ParseError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("--confine"));
        EXPECT_THAT(error.what(), testing::HasSubstr("'maybe'"));
    }
}

TEST(SceneRules, EveryMpipovThatIsStartedGetsThem) {
    const SceneRules rules = parsed({"--allow-read", "a", "--confine", "on"});
    SpeedupTools speedup;
    speedup.rules = rules;
    EXPECT_THAT(speedup_command({SpeedupVariant::Kind::mpipov, 2, "static", false}, speedup, {},
                                "out", "run.json"),
                IsSupersetOf(rules.given));
    // POV-Ray knows no such options.
    for (const auto kind : {SpeedupVariant::Kind::serial, SpeedupVariant::Kind::bands})
        EXPECT_THAT(speedup_command({kind, 2, {}, false}, speedup, {}, "out", "run.json"),
                    testing::Not(testing::Contains("--confine=on")));

    const ScratchFolder scratch("rules");
    TradeoffTools tradeoff;
    tradeoff.rules = parsed({"--confine", "auto"});
    const TradeoffRenderer renderer(tradeoff, {"scene.pov"}, scratch.path());
    TradeoffSetting setting;
    setting.mpipov = true;
    EXPECT_THAT(renderer.argv(setting), testing::Contains("--confine=auto"));
    EXPECT_THAT(renderer.user_argv(setting), testing::Contains("--confine=auto"));
    setting.mpipov = false;
    EXPECT_THAT(renderer.argv(setting), testing::Not(testing::Contains("--confine=auto")));
}

TEST(SceneRules, ASceneReadsItsFolderAndWhatIsAllowed) {
    if (!can_restrict_files()) GTEST_SKIP() << "this kernel has no Landlock";
    const ScratchFolder place("rules");
    const auto folder = [&](const char* name) {
        const fs::path path = place.path() / name;
        fs::create_directories(path);
        std::ofstream(path / "a.pov") << "sphere { 0, 1 }\n";
        return path;
    };
    const fs::path scene = folder("scene"), allowed = folder("allowed"), other = folder("other");
    const auto confined = [&](const std::vector<std::string>& options) {
        return confinement_by(parsed(options), "povray", {(scene / "a.pov").string()},
                              place.path() / "own");
    };
    const Confinement confinement = confined({"--allow-read", allowed.string()});
    EXPECT_TRUE(confinement.may_read(scene / "a.pov"));
    EXPECT_TRUE(confinement.may_read(allowed / "a.pov"));
    EXPECT_FALSE(confinement.may_read(other / "a.pov"));
    EXPECT_TRUE(confined({"--confine", "off"}).may_read(other / "a.pov"));
}

}  // namespace
}  // namespace mpipov
