#include "scene_plan.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace mpipov {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr double infinite = std::numeric_limits<double>::infinity();

// A scene without any effect whose whole render takes `cpu_seconds`.
ProbeResult scene(int width, int height, double cpu_seconds) {
    ProbeResult probe;
    probe.image.width = width;
    probe.image.height = height;
    probe.image.region = {0, 0, width, height};
    probe.probe_pixels = 768;
    probe.report.trace_cpu = cpu_seconds * 768 / (1.0 * width * height);
    probe.report.parse_cpu = 0.01;
    probe.stored = {width, height, 3, "png", "uint8"};
    return probe;
}

ProbeResult with_antialiasing(ProbeResult probe, int method) {
    probe.report.antialiasing = {true, method, 3, 0.3};
    return probe;
}

ProbeResult order_dependent(ProbeResult probe) {
    probe.order_dependent = true;
    return probe;
}

PlanRequest ranks(std::vector<int> slots) {
    PlanRequest request;
    request.slots = std::move(slots);
    return request;
}

// Every pixel of the region belongs to one section, and nothing is rendered outside the region.
void expect_sound(const Plan& plan, const ProbeResult& probe) {
    const Rect region = probe.image.region;
    long long area = 0;
    for (const Section& section : plan.partition.sections) {
        EXPECT_FALSE(section.keep.empty());
        EXPECT_EQ(intersect(section.render, region), section.render);
        EXPECT_EQ(intersect(section.keep, section.render), section.keep);
        area += section.keep.area();
    }
    EXPECT_EQ(area, region.area());
    EXPECT_EQ(plan.partition.sections.size(), static_cast<std::size_t>(plan.record.sections));
    EXPECT_GE(plan.record.threads, 1);
    EXPECT_GE(plan.record.in_flight, 1);
    EXPECT_TRUE(std::isfinite(plan.record.predicted.wall_seconds));
    EXPECT_TRUE(std::isfinite(plan.record.predicted.cpu_seconds));
    EXPECT_GE(plan.record.predicted.cpu_seconds, 0);
}

std::string refusal(const PlanRequest& request, const ProbeResult& probe) {
    try {
        make_plan(request, probe);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    ADD_FAILURE() << "accepted";
    return {};
}

TEST(ScenePlan, SeamsFollowTheAntialiasing) {
    const ProbeResult plain = scene(640, 480, 60);
    EXPECT_EQ(make_plan(ranks({1, 1}), plain).record.seams, Seams::plain);
    EXPECT_EQ(make_plan(ranks({1, 1}), with_antialiasing(plain, 1)).record.seams, Seams::aligned);
    EXPECT_EQ(make_plan(ranks({1, 1}), with_antialiasing(plain, 2)).record.seams, Seams::plain);
    PlanRequest request = ranks({1, 1});
    request.seams = Seams::plain;
    EXPECT_EQ(make_plan(request, with_antialiasing(plain, 1)).record.seams, Seams::plain);
}

TEST(ScenePlan, AlignedEdgesLieOnTheBlocks) {
    const ProbeResult probe = with_antialiasing(scene(640, 480, 600), 1);
    const Plan plan = make_plan(ranks({1, 1, 1, 1}), probe);
    expect_sound(plan, probe);
    EXPECT_EQ(plan.record.block, 32);
    EXPECT_GT(plan.record.sections, 4);
    for (const Section& section : plan.partition.sections) {
        EXPECT_EQ(section.keep.x0 % 32, 0);
        EXPECT_EQ(section.keep.y0 % 32, 0);
    }
}

TEST(ScenePlan, TheUsersBlockSizeIsTheGrid) {
    ProbeResult probe = with_antialiasing(scene(640, 480, 600), 1);
    probe.user_block = 64;
    const Plan plan = make_plan(ranks({1, 1, 1, 1}), probe);
    EXPECT_EQ(plan.record.block, 64);
    for (const Section& section : plan.partition.sections) {
        EXPECT_EQ(section.keep.x0 % 64, 0);
        EXPECT_EQ(section.keep.y0 % 64, 0);
    }
    probe.user_block = 4096;  // the whole image is one block
    EXPECT_EQ(make_plan(ranks({1, 1, 1, 1}), probe).record.sections, 1);
}

TEST(ScenePlan, ColumnsWhileTheySufficeThenTiles) {
    const ProbeResult probe = with_antialiasing(scene(640, 480, 3600), 1);  // 20 columns of blocks
    PlanRequest request = ranks({1});
    for (const auto& [sections, shape] : {std::pair{1, Shape::columns},
                                          {20, Shape::columns},
                                          {21, Shape::tiles},
                                          {300, Shape::tiles}}) {
        request.sections = sections;
        const Plan plan = make_plan(request, probe);
        EXPECT_EQ(plan.record.shape, shape) << sections;
        EXPECT_EQ(plan.record.sections, sections);
        expect_sound(plan, probe);
    }
    const Plan many = make_plan(ranks(std::vector<int>(64, 1)), probe);
    EXPECT_EQ(many.record.shape, Shape::tiles);
    EXPECT_GE(many.record.sections, 64);
}

TEST(ScenePlan, AShapeThatIsAskedForIsKept) {
    const ProbeResult probe = with_antialiasing(scene(640, 480, 3600), 1);
    for (const Shape shape : {Shape::columns, Shape::rows, Shape::tiles}) {
        PlanRequest request = ranks(std::vector<int>(64, 1));
        request.shape = shape;
        const Plan plan = make_plan(request, probe);
        EXPECT_EQ(plan.record.shape, shape);
        expect_sound(plan, probe);
    }
}

TEST(ScenePlan, AnImpossibleNumberOfSectionsNamesTheOption) {
    const ProbeResult probe = with_antialiasing(scene(640, 480, 60), 1);
    PlanRequest request = ranks({1});
    request.sections = 301;  // 20 x 15 blocks
    EXPECT_THAT(refusal(request, probe), HasSubstr("--sections 301"));
    request.shape = Shape::columns;
    request.sections = 21;
    EXPECT_THAT(refusal(request, probe), HasSubstr("--sections 21"));
    EXPECT_THAT(refusal(request, probe), HasSubstr("1 to 20"));
}

// MPIPOV2: n+1 <= G <= W for n slaves and an image W wide.
TEST(ScenePlan, ThePapersBounds) {
    const ProbeResult probe = scene(100, 80, 60);
    PlanRequest request = ranks({0, 1, 1, 1});
    request.dedicated_coordinator = true;
    request.shape = Shape::columns;
    request.sections = 3;
    EXPECT_THAT(refusal(request, probe), HasSubstr("--sections 3"));
    EXPECT_THAT(refusal(request, probe), HasSubstr("4"));
    for (const int sections : {4, 100}) {
        request.sections = sections;
        expect_sound(make_plan(request, probe), probe);
    }
    request.sections = 101;
    EXPECT_THAT(refusal(request, probe), HasSubstr("--sections 101"));
    request.shape.reset();  // which must not turn strips into tiles
    EXPECT_THAT(refusal(request, probe), HasSubstr("--sections 101"));
    request.shape = Shape::tiles;
    expect_sound(make_plan(request, probe), probe);
    // MPIPOV1 has one strip for each slave.
    request.schedule = Policy::static_;
    request.sections = 3;
    EXPECT_EQ(make_plan(request, probe).record.sections, 3);
}

TEST(ScenePlan, ADedicatedCoordinatorGetsEnoughSectionsWhereThereAreAny) {
    PlanRequest request = ranks({0, 1, 1, 1, 1, 1});
    request.dedicated_coordinator = true;
    const ProbeResult short_one = scene(100, 80, 0.001);
    EXPECT_GE(make_plan(request, short_one).record.sections, 6);
    // One block is all there is to cut up.
    const ProbeResult tiny = with_antialiasing(scene(32, 32, 0.001), 1);
    EXPECT_EQ(make_plan(request, tiny).record.sections, 1);
}

TEST(ScenePlan, NoRankLeftIsRefused) {
    EXPECT_THAT(refusal(ranks({0}), scene(64, 48, 1)), HasSubstr("--dedicated-coordinator"));
    EXPECT_THAT(refusal(ranks({}), scene(64, 48, 1)), HasSubstr("rank"));
}

TEST(ScenePlan, ThePinnedGridComesFromTheImageAlone) {
    for (const int method : {1, 2}) {
        const ProbeResult probe = order_dependent(with_antialiasing(scene(640, 480, 60), method));
        const Plan first = make_plan(ranks({1}), probe);
        EXPECT_GE(first.record.sections, 4);
        EXPECT_TRUE(first.record.effects.at("order_dependent").on);
        for (const Policy policy : {Policy::static_, Policy::dynamic})
            for (const std::vector<int>& slots :
                 {std::vector<int>{1}, {8}, {1, 1, 1}, {0, 64, 2}, std::vector<int>(300, 4)})
                for (const double seconds : {0.0, 1e-9, 0.5, 1e9, infinite}) {
                    PlanRequest request = ranks(slots);
                    request.schedule = policy;
                    request.dedicated_coordinator = slots[0] == 0;
                    ProbeResult timed = probe;
                    timed.report.trace_cpu = seconds;
                    timed.report.parse_cpu = seconds / 3;
                    const Plan plan = make_plan(request, timed);
                    EXPECT_EQ(plan.partition, first.partition);
                    EXPECT_EQ(plan.record.threads, 1);
                }
    }
}

TEST(ScenePlan, RadiosityIsPinned) {
    ProbeResult probe = scene(640, 480, 60);
    probe.report.radiosity = true;
    probe.report.radiosity_cpu = 2;
    const Plan one = make_plan(ranks({1}), probe), many = make_plan(ranks({4, 4, 4}), probe);
    EXPECT_TRUE(one.record.effects.at("order_dependent").on);
    EXPECT_EQ(one.partition, many.partition);
    EXPECT_EQ(many.record.threads, 1);
}

ProbeResult with_radiosity(ProbeResult probe) {
    probe.report.radiosity = true;
    probe.report.radiosity_cpu = 2;
    return probe;
}

TEST(ScenePlan, RadiosityIsJoinedInWavesThatTheImageAloneDecides) {
    const ProbeResult probe = with_radiosity(scene(640, 480, 60));
    const Plan one = make_plan(ranks({1}), probe), many = make_plan(ranks({4, 4, 4}), probe);
    EXPECT_EQ(one.record.radiosity, (RadiositySharing{Sharing::joined, 1, 1}));
    ASSERT_EQ(one.waves.size(), 2U);
    ASSERT_EQ(many.waves.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(one.waves[i].sections, many.waves[i].sections);
}

TEST(ScenePlan, NothingIsGatheredThatTheSceneDoesNotCallFor) {
    PlanRequest request = ranks({2});
    const Plan plain = make_plan(request, scene(640, 480, 60));
    EXPECT_EQ(plain.record.radiosity.how, Sharing::independent);
    EXPECT_TRUE(plain.waves.empty());
    request.radiosity = Sharing::shared;
    const Plan asked = make_plan(request, scene(640, 480, 60));
    EXPECT_TRUE(asked.waves.empty());
    EXPECT_THAT(asked.notes, testing::Contains(HasSubstr("has no radiosity")));
    EXPECT_EQ(asked.record.predicted.cpu_seconds, plain.record.predicted.cpu_seconds);
}

TEST(ScenePlan, RadiosityIsSharedAsAskedFor) {
    const ProbeResult probe = with_radiosity(scene(640, 480, 60));
    PlanRequest request = ranks({2});
    request.radiosity = Sharing::independent;
    EXPECT_TRUE(make_plan(request, probe).waves.empty());
    request.radiosity = Sharing::shared;
    request.radiosity_passes = 3;
    request.radiosity_scale = 2;
    const Plan plan = make_plan(request, probe);
    EXPECT_EQ(plan.record.radiosity, (RadiositySharing{Sharing::shared, 3, 2}));
    ASSERT_EQ(plan.waves.size(), 3U);
    EXPECT_EQ(plan.waves[0].image.width, 320);
}

TEST(ScenePlan, RadiosityHasFewerAndLargerSections) {
    const Plan jitter = make_plan(ranks({2}), order_dependent(scene(1600, 1200, 60)));
    const Plan lit = make_plan(ranks({2}), with_radiosity(scene(1600, 1200, 60)));
    EXPECT_EQ(jitter.record.sections, 48);
    EXPECT_EQ(lit.record.sections, 19);
}

TEST(ScenePlan, SamplesOfLargeImagesAreGatheredSmall) {
    for (const auto& [width, height, scale] : {std::tuple{320, 240, 1},
                                               {799, 300, 1},
                                               {800, 600, 2},
                                               {300, 1600, 4},
                                               {8000, 6000, 20}}) {
        const ProbeResult probe = with_radiosity(scene(width, height, 60));
        PlanRequest request = ranks({2});
        EXPECT_EQ(make_plan(request, probe).record.radiosity.scale, scale) << width;
        request.radiosity = Sharing::shared;
        EXPECT_EQ(make_plan(request, probe).record.radiosity.scale, 1);
        request.radiosity = Sharing::joined;
        request.radiosity_scale = 1;
        EXPECT_EQ(make_plan(request, probe).record.radiosity.scale, 1);
    }
}

TEST(ScenePlan, OneSectionHasNobodyToShareWith) {
    const ProbeResult probe = with_radiosity(scene(32, 32, 1));
    PlanRequest request = ranks({2});
    request.seams = Seams::aligned;
    request.early_threads = 1;
    const Plan plan = make_plan(request, probe);
    ASSERT_EQ(plan.record.sections, 1);
    EXPECT_TRUE(plan.waves.empty());
    EXPECT_TRUE(plan.takes_early);
    // A more accurate render may be wanted.
    request.radiosity = Sharing::shared;
    const Plan asked = make_plan(request, probe);
    EXPECT_EQ(asked.waves.size(), 1U);
    EXPECT_FALSE(asked.takes_early);
}

TEST(ScenePlan, AUsersOwnRadiosityCacheIsLeftAlone) {
    ProbeResult probe = with_radiosity(scene(640, 480, 60));
    probe.own_cache = true;
    PlanRequest request = ranks({2});
    EXPECT_TRUE(make_plan(request, probe).waves.empty());
    request.radiosity = Sharing::joined;
    const Plan asked = make_plan(request, probe);
    EXPECT_TRUE(asked.waves.empty());
    EXPECT_THAT(asked.notes, testing::Contains(HasSubstr("+RFI")));
    probe.own_cache = false;
    probe.writes_cache = true;
    const Plan writing = make_plan(request, probe);
    EXPECT_FALSE(writing.waves.empty());
    EXPECT_THAT(writing.notes, testing::Contains(HasSubstr("+RFO")));
}

TEST(ScenePlan, WavesTakeTheirTimeAndSaveThePretrace) {
    const ProbeResult probe = with_radiosity(scene(640, 480, 60));
    PlanRequest request = ranks({2});
    request.radiosity = Sharing::independent;
    const Predicted alone = make_plan(request, probe).record.predicted;
    request.radiosity = Sharing::joined;
    const Plan joined = make_plan(request, probe);
    request.radiosity = Sharing::shared;
    const Predicted shared = make_plan(request, probe).record.predicted;
    EXPECT_GT(joined.record.predicted.cpu_seconds, alone.cpu_seconds);
    EXPECT_NEAR(joined.record.predicted.cpu_seconds - alone.cpu_seconds,
                60 + joined.record.sections * 0.1, joined.record.sections * 0.1);
    // Two cores halve the waves of joined, and cannot help a pass of shared.
    EXPECT_LT(joined.record.predicted.wall_seconds, shared.wall_seconds);
    EXPECT_LT(shared.cpu_seconds, joined.record.predicted.cpu_seconds);
}

TEST(ScenePlan, PinnedGridsFitSmallImagesAndLargeOnes) {
    for (const int side : {1, 2, 31, 33, 100, 8000, 20000})
        for (const int method : {1, 2}) {
            const ProbeResult probe =
                order_dependent(with_antialiasing(scene(side, side, 60), method));
            const Plan plan = make_plan(ranks({2, 2}), probe);
            expect_sound(plan, probe);
            EXPECT_LE(plan.record.sections, 64);
        }
}

TEST(ScenePlan, MoreThreadsThanOneForAPinnedSceneAreSaid) {
    PlanRequest request = ranks({4});
    request.threads = 4;
    const Plan plan = make_plan(request, order_dependent(scene(640, 480, 60)));
    EXPECT_EQ(plan.record.threads, 4);
    EXPECT_THAT(plan.notes, testing::Contains(HasSubstr("order of rendering")));
}

TEST(ScenePlan, StaticIsOneSectionALane) {
    const ProbeResult probe = scene(640, 480, 60);
    PlanRequest request = ranks({1, 1, 1, 1, 1});
    request.schedule = Policy::static_;
    EXPECT_EQ(make_plan(request, probe).record.sections, 5);
    request.slots = {0, 2, 3};
    EXPECT_EQ(make_plan(request, probe).record.sections, 5);
    request.slots = {3, 3};
    request.threads = 2;  // three cores hold one launch of two threads
    EXPECT_EQ(make_plan(request, probe).record.sections, 2);
    EXPECT_EQ(make_plan(request, probe).record.schedule, "static");
    request.threads = 8;
    EXPECT_EQ(make_plan(request, probe).record.sections, 2);
}

TEST(ScenePlan, OneHostOfManyCoresRendersAnExactSceneInThreads) {
    const ProbeResult probe = with_antialiasing(scene(640, 480, 30), 1);
    const Plan plan = make_plan(ranks({8}), probe);
    EXPECT_EQ(plan.record.threads, 8);
    EXPECT_EQ(plan.record.sections, 1);
    PlanRequest request = ranks({8});
    request.threads = 1;
    const Plan single = make_plan(request, probe);
    EXPECT_EQ(single.record.threads, 1);
    EXPECT_GE(single.record.sections, 8);
    EXPECT_GE(single.record.in_flight, 8);
}

// A launch with a halo renders its section as one block, and POV-Ray's threads share blocks.
TEST(ScenePlan, HaloLaunchesHaveOneThread) {
    const ProbeResult probe = with_antialiasing(scene(640, 480, 30), 1);
    PlanRequest request = ranks({8});
    request.seams = Seams::halo;
    request.halo = 3;
    const Plan plan = make_plan(request, probe);
    EXPECT_EQ(plan.record.threads, 1);
    EXPECT_GE(plan.record.sections, 8);
    EXPECT_EQ(plan.record.halo, 3);
    expect_sound(plan, probe);
    request.threads = 4;
    const Plan asked = make_plan(request, probe);
    EXPECT_EQ(asked.record.threads, 1);
    EXPECT_THAT(asked.notes, testing::Contains(HasSubstr("--threads")));
}

TEST(ScenePlan, OnlyHaloHasAnOverlap) {
    PlanRequest request = ranks({1, 1});
    request.halo = 3;
    EXPECT_EQ(make_plan(request, scene(64, 48, 1)).record.halo, 0);
}

TEST(ScenePlan, InFlightIsEnoughToHideTheIdleStart) {
    PlanRequest request = ranks({1, 1});
    request.sections = 40;
    const int quick = make_plan(request, scene(640, 480, 0.4)).record.in_flight;
    const int slow = make_plan(request, scene(640, 480, 4000)).record.in_flight;
    EXPECT_EQ(quick, 5) << "0.1 s of work against 0.32 s of idling: four more than compute";
    EXPECT_EQ(slow, 2);
    request.sections = 2;  // one for each rank: nothing could be under way besides
    EXPECT_EQ(make_plan(request, scene(640, 480, 0.4)).record.in_flight, 1);
    request.in_flight = 9;
    EXPECT_EQ(make_plan(request, scene(640, 480, 0.4)).record.in_flight, 9);
}

TEST(ScenePlan, MoreRanksThanSectionsAreSaid) {
    PlanRequest request = ranks({1, 1, 1, 1});
    request.sections = 2;
    EXPECT_THAT(make_plan(request, scene(64, 48, 1)).notes,
                testing::Contains(HasSubstr("2 of 4 ranks")));
    request.sections = 4;
    EXPECT_THAT(make_plan(request, scene(64, 48, 1)).notes, IsEmpty());
}

TEST(ScenePlan, WildTimesGiveSoundPlans) {
    const std::vector<double> times{0, 1e-9, 1, 1e9, 1e300, infinite, -infinite, -1, std::nan("")};
    for (const double trace : times)
        for (const double parse : times)
            for (const int photons : {0, 1})
                for (const auto& [w, h] : {std::pair{1, 1}, {1, 900}, {640, 480}, {16000, 9000}}) {
                    SCOPED_TRACE(fmt::format("{} {} {} {}x{}", trace, parse, photons, w, h));
                    ProbeResult probe = with_antialiasing(scene(w, h, 1), 1);
                    probe.report.trace_cpu = trace;
                    probe.report.parse_cpu = parse;
                    probe.report.photons = photons == 1;
                    probe.report.photon_cpu = parse;
                    for (const std::vector<int>& slots :
                         {std::vector<int>{1}, {2, 2, 2}, std::vector<int>(100, 1)}) {
                        const Plan plan = make_plan(ranks(slots), probe);
                        expect_sound(plan, probe);
                        EXPECT_LE(plan.record.sections,
                                  64 * std::accumulate(slots.begin(), slots.end(), 0));
                        EXPECT_NO_THROW(
                            plan_from_json(nlohmann::json::parse(to_json(plan.record).dump())));
                    }
                }
}

TEST(ScenePlan, ALongRenderIsCutSoThatLittleIsLost) {
    const Plan plan = make_plan(ranks({1}), scene(640, 480, 3600));
    EXPECT_GE(plan.record.sections, 50);
}

TEST(ScenePlan, DearLaunchesAreFewer) {
    ProbeResult cheap = scene(640, 480, 100), dear = cheap;
    dear.report.parse_cpu = 20;
    EXPECT_LT(make_plan(ranks({1, 1, 1, 1}), dear).record.sections,
              make_plan(ranks({1, 1, 1, 1}), cheap).record.sections);
}

TEST(ScenePlan, ARegionIsAllThatIsPlanned) {
    ProbeResult probe = with_antialiasing(scene(640, 480, 60), 1);
    probe.image.region = {7, 5, 300, 210};
    const Plan plan = make_plan(ranks({1, 1, 1}), probe);
    expect_sound(plan, probe);
    EXPECT_EQ(plan.record.region, probe.image.region);
    EXPECT_EQ(plan.record.image.width, 640);
}

TEST(ScenePlan, RanksOfOneHostGiveTheirCoresToOneLaunchWhereThatIsFaster) {
    PlanRequest request;
    request.slots = {1, 1};
    request.pools = {2, 0};
    const Plan plan = make_plan(request, scene(640, 480, 30));
    EXPECT_EQ(plan.record.sections, 1);
    EXPECT_EQ(plan.record.threads, 2);
    EXPECT_THAT(plan.slots, testing::ElementsAre(2, 0));
    EXPECT_THAT(plan.notes, testing::IsEmpty());

    request.threads = 1;
    EXPECT_THAT(make_plan(request, scene(640, 480, 30)).slots, testing::ElementsAre(1, 1));
    request.threads.reset();
    request.dedicated_coordinator = true;
    request.slots = {0, 1};
    EXPECT_THAT(make_plan(request, scene(640, 480, 30)).slots, testing::ElementsAre(0, 1));
    request.dedicated_coordinator = false;
    request.slots = {1, 1};
    request.schedule = Policy::static_;
    EXPECT_EQ(make_plan(request, scene(640, 480, 30)).record.sections, 2) << "as MPIPOV1";
}

// All launches have equally many threads.
TEST(ScenePlan, UnequalHostsAreNotPooled) {
    PlanRequest request;
    request.slots = {1, 1, 2, 2};
    request.pools = {2, 0, 4, 0};
    EXPECT_THAT(make_plan(request, scene(640, 480, 30)).slots, testing::ElementsAre(1, 1, 2, 2));
}

TEST(ScenePlan, AnOrderDependentSceneIsNotRenderedByThreads) {
    PlanRequest request;
    request.slots = {1, 1};
    request.pools = {2, 0};
    request.early_threads = 2;
    ProbeResult probe = scene(640, 480, 30);
    probe.order_dependent = true;
    const Plan plan = make_plan(request, probe);
    EXPECT_EQ(plan.record.threads, 1);
    EXPECT_FALSE(plan.takes_early);
    EXPECT_THAT(plan.slots, testing::ElementsAre(1, 1));
}

TEST(ScenePlan, PhotonsAreShotByOneThread) {
    ProbeResult probe = scene(640, 480, 30);
    probe.report.photons = true;
    probe.report.photon_cpu = 100;  // would be paid once by one launch of all threads
    PlanRequest request = ranks({8});
    request.early_threads = 8;
    const Plan plan = make_plan(request, probe);
    EXPECT_EQ(plan.record.threads, 1);
    EXPECT_FALSE(plan.takes_early);
    EXPECT_THAT(plan.notes, IsEmpty());
    request.threads = 4;
    const Plan asked = make_plan(request, probe);
    EXPECT_EQ(asked.record.threads, 4);
    EXPECT_THAT(asked.notes, testing::Contains(HasSubstr("photons")));
}

TEST(ScenePlan, TakesTheEarlyLaunchWhereItIsThePlan) {
    PlanRequest request;
    request.slots = {2};
    request.pools = {2};
    request.early_threads = 2;
    EXPECT_TRUE(make_plan(request, scene(640, 480, 1)).takes_early);
    request.threads = 1;
    EXPECT_FALSE(make_plan(request, scene(640, 480, 1)).takes_early) << "other threads";
    request.threads.reset();
    request.seams = Seams::halo;
    EXPECT_FALSE(make_plan(request, scene(640, 480, 1)).takes_early) << "another block size";
    request.seams.reset();
    request.sections = 4;
    EXPECT_FALSE(make_plan(request, scene(640, 480, 1)).takes_early);
}

TEST(ScenePlan, RanksHaveLaunchesUnderWayByTheirSlots) {
    PlanRequest request;
    request.slots = {1, 4};
    request.threads = 1;
    request.sections = 40;
    request.shape = Shape::tiles;
    const Plan plan = make_plan(request, scene(640, 480, 400));
    ASSERT_EQ(plan.in_flight.size(), 2u);
    EXPECT_EQ(plan.in_flight[1], 4 * plan.in_flight[0]);
    EXPECT_EQ(plan.record.in_flight, plan.in_flight[1]);
}

TEST(ScenePlan, ACutKeepsThePapersLowerBound) {
    PlanRequest request = ranks({0, 1, 1});
    request.dedicated_coordinator = true;
    request.schedule = Policy::cost;
    request.costs = uniform_costs({0, 0, 640, 480}, 0.01);
    EXPECT_GE(make_plan(request, scene(640, 480, 0.01)).record.sections, 3);
}

TEST(ScenePlan, CostCutsWhereTheCostIs) {
    PlanRequest request;
    request.slots = {1, 1};
    request.schedule = Policy::cost;
    request.costs.emplace(Rect{0, 0, 640, 480},
                          std::vector<CostPatch>{{{0, 0, 160, 480}, 30}, {{160, 0, 640, 480}, 3}});
    const ProbeResult probe = scene(640, 480, 100);
    const Plan plan = make_plan(request, probe);
    ASSERT_EQ(plan.costs.size(), plan.partition.sections.size());
    EXPECT_EQ(plan.record.cuts.size(), plan.partition.sections.size());
    EXPECT_EQ(plan.record.shape, Shape::tiles);
    EXPECT_EQ(plan.record.threads, 1);
    EXPECT_LT(plan.record.predicted.cpu_seconds, 40) << "what is known, not the probe's guess";
    EXPECT_LT(*std::max_element(plan.costs.begin(), plan.costs.end()), 33.0 / 2 / 3 + 1);

    request.shape = Shape::columns;
    EXPECT_TRUE(make_plan(request, probe).record.cuts.empty()) << "as the user wants it";
    ProbeResult pinned = probe;
    pinned.order_dependent = true;
    request.shape.reset();
    const Plan same_grid = make_plan(request, pinned);
    EXPECT_TRUE(same_grid.record.cuts.empty()) << "its pixels depend on the grid";
    EXPECT_EQ(same_grid.costs.size(), same_grid.partition.sections.size());
}

}  // namespace
}  // namespace mpipov
