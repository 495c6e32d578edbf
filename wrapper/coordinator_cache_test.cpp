#include "coordinator_test_support.h"
#include "failure.h"

#include <gmock/gmock.h>

namespace mpipov {
namespace {

using testing::HasSubstr;

constexpr Rect region{0, 0, 64, 48};

RigSetup columns(int sections, int workers) {
    RigSetup setup;
    setup.grid = {region, Shape::columns, Seams::plain, sections, 0, 32};
    setup.workers = workers;
    return setup;
}

TEST(CoordinatorCache, EveryRankThatRendersGetsAllOfIt) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        RigSetup setup = columns(7, 3);
        setup.seed = seed;
        setup.cache = std::string(max_band_bytes * 2 + 5, 'x') + "end";
        Rig rig(setup);
        rig.run();
        EXPECT_TRUE(holds_known_picture(rig.canvas(), region));
        for (const FakeWorker& worker : rig.workers())
            if (!worker.assignments().empty()) {
                EXPECT_TRUE(worker.cache() == setup.cache);
            }
    }
}

TEST(CoordinatorCache, ADedicatedCoordinatorGetsNone) {
    RigSetup setup = columns(7, 3);
    setup.dedicated_coordinator = true;
    setup.cache = "some";
    Rig rig(setup);
    rig.run();
    EXPECT_EQ(rig.workers()[0].cache(), "");
    EXPECT_EQ(rig.workers()[1].cache(), "some");
}

TEST(CoordinatorCache, SamplesComeBySectionWhicheverEndsFirst) {
    std::vector<std::string> expected;
    for (const Section& section : make_partition(columns(9, 1).grid).sections)
        expected.push_back(FakeWorker::sample_of(section.render));
    for (unsigned seed = 1; seed <= 30; ++seed) {
        RigSetup setup = columns(9, 1 + static_cast<int>(seed % 4));
        setup.seed = seed;
        setup.gathers = true;
        setup.policy = seed % 2 == 0 ? Policy::dynamic : Policy::static_;
        Rig rig(setup);
        rig.run();
        EXPECT_EQ(rig.coordinator().samples(), expected);
    }
}

TEST(CoordinatorCache, BytesOfASectionAreThoseOfItsPixels) {
    Rig rig(columns(4, 1));
    const Rect render = make_partition(columns(4, 1).grid).sections.at(3).render;
    EXPECT_EQ(rig.coordinator().bytes_of(3),
              static_cast<std::uintmax_t>(render.area()) * known_channels);
    EXPECT_FALSE(rig.coordinator().bytes_of(4));
    EXPECT_FALSE(rig.coordinator().bytes_of(-1));
}

TEST(CoordinatorCache, WhatAFailedAttemptSentDoesNotCount) {
    RigSetup setup = columns(5, 2);
    setup.gathers = true;
    setup.worker.fault = [](int, const Assignment& what) {
        return what.attempt == 1 && what.section.id % 2 == 0 ? std::string("on purpose")
                                                             : std::string();
    };
    Rig rig(setup);
    rig.run();
    EXPECT_EQ(rig.record().totals.retries, 3);
    for (const std::string& samples : rig.coordinator().samples())
        EXPECT_THAT(samples, testing::Not(HasSubstr("garbage")));
}

TEST(CoordinatorCache, AFullDiskIsAFailureOfFiles) {
    for (const auto& [why, code] :
         {std::pair{"disk full", Exit::file}, std::pair{"on purpose", Exit::scene}}) {
        RigSetup setup = columns(2, 1);
        setup.gathers = true;
        setup.worker.fault = [why = std::string(why)](int, const Assignment&) { return why; };
        Rig rig(setup);
        try {
            rig.run();
            FAIL() << why;
        } catch (const Failure& failure) {
            EXPECT_EQ(failure.code(), code) << why;
            EXPECT_THAT(failure.what(), HasSubstr(why));
        }
    }
}

TEST(CoordinatorCache, PixelsAndSamplesAreNotMistakenForEachOther) {
    for (const bool gathers : {false, true}) {
        RigSetup setup = columns(2, 1);
        setup.gathers = gathers;
        Rig rig(setup);
        rig.coordinator().start();
        const MessageKind wrong = gathers ? MessageKind::band : MessageKind::samples;
        EXPECT_THROW(rig.coordinator().handle({wrong, 0, {{"section", 0}, {"attempt", 1}}, {}}),
                     std::runtime_error);
    }
}

}  // namespace
}  // namespace mpipov
