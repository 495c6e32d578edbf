// The self-check of the overlaps, seams that are rendered again, and resuming.
#include "coordinator_test_support.h"
#include "failure.h"
#include "scratch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace mpipov {
namespace {

// What stands for a renderer whose antialiasing lacks a neighbour: pixels nearer than `reach` to an
// edge of what is rendered (and not of the region) are wrong, by another value in every launch.
int error_of(const Rect& render) {
    return 10 + (render.x0 * 3 + render.x1 * 5 + render.y0 * 7 + render.y1 * 11) % 41;
}

std::function<std::vector<std::byte>(const Rect&)> wrong_near_edges(int reach, const Rect& region) {
    return [=](const Rect& render) {
        std::vector<std::byte> pixels = known_pixels(render);
        std::size_t at = 0;
        for (int y = render.y0; y < render.y1; ++y)
            for (int x = render.x0; x < render.x1; ++x, at += known_channels) {
                const bool wrong = (render.x0 > region.x0 && x < render.x0 + reach) ||
                                   (render.x1 < region.x1 && x >= render.x1 - reach) ||
                                   (render.y0 > region.y0 && y < render.y0 + reach) ||
                                   (render.y1 < region.y1 && y >= render.y1 - reach);
                if (wrong)
                    pixels[at] =
                        static_cast<std::byte>(std::to_integer<int>(pixels[at]) + error_of(render));
            }
        return pixels;
    };
}

RigSetup halo_setup(const Rect& region, Shape shape, int sections, int reach) {
    RigSetup setup;
    setup.grid = {region, shape, Seams::halo, sections, 2, 32};
    setup.workers = 3;
    setup.in_flight = 2;
    setup.worker.render = wrong_near_edges(reach, region);
    setup.worker.band_rows = 7;
    return setup;
}

// Half of the halo must be free of the edge's influence.
int halo_needed(int reach) {
    int halo = 2;
    while (halo / 2 < reach) halo *= 2;
    return halo;
}

TEST(CoordinatorSeams, AreRenderedAgainUntilTheyAgree) {
    constexpr Rect region{3, 2, 3 + 3 * 70, 2 + 24};
    for (const Shape shape : {Shape::columns, Shape::rows})
        for (int reach = 0; reach <= 16; ++reach) {
            Rect r = region;
            if (shape == Shape::rows) r = {region.y0, region.x0, region.y1, region.x1};
            const RigSetup setup = halo_setup(r, shape, 3, reach);
            Rig rig(setup);
            rig.run();
            EXPECT_TRUE(holds_known_picture(rig.canvas(), r)) << "reach " << reach;
            const RunRecord record = rig.record();
            int rendered_again = 0;
            for (int halo = 4; halo <= halo_needed(reach); halo *= 2) ++rendered_again;
            EXPECT_EQ(record.totals.launches, 3 + 2 * rendered_again) << "reach " << reach;
            EXPECT_EQ(record.totals.retries, 0);
            ASSERT_EQ(record.seams.size(), 2u);
            const std::vector<Section> sections = make_partition(setup.grid).sections;
            for (const SeamRecord& seam : record.seams) {
                EXPECT_TRUE(seam.checked);
                EXPECT_EQ(seam.halo, halo_needed(reach)) << "reach " << reach;
                EXPECT_EQ(seam.differing, reach <= 1 ? 0 : 2 * 24);
                if (reach == 2) {
                    const auto a = static_cast<std::size_t>(seam.seam.a);
                    EXPECT_EQ(seam.max_difference, std::max(error_of(sections[a].render),
                                                            error_of(sections[a + 1].render)));
                }
            }
        }
}

TEST(CoordinatorSeams, OfTilesAreRightAtTheCornersToo) {
    constexpr Rect region{0, 0, 150, 130};
    for (const int sections : {4, 5, 6})
        for (int reach = 1; reach <= 8; ++reach)
            for (unsigned seed = 1; seed <= 3; ++seed) {
                RigSetup setup = halo_setup(region, Shape::tiles, sections, reach);
                setup.seed = seed;
                Rig rig(setup);
                rig.run();
                EXPECT_TRUE(holds_known_picture(rig.canvas(), region))
                    << sections << " tiles, reach " << reach << ", seed " << seed;
            }
}

TEST(CoordinatorSeams, ThatNeverAgreeStopAtTheWidestHalo) {
    constexpr Rect region{0, 0, 400, 10};
    for (const int widest : {2, 4, 7, 8, 32}) {
        RigSetup setup = halo_setup(region, Shape::columns, 3, 1000);
        setup.widest_halo = widest;
        Rig rig(setup);
        rig.run();
        int last = 2, rendered_again = 0;
        for (; last * 2 <= widest; last *= 2) ++rendered_again;
        const RunRecord record = rig.record();
        EXPECT_EQ(record.totals.launches, 3 + 2 * rendered_again) << widest;
        for (const SeamRecord& seam : record.seams) {
            EXPECT_EQ(seam.halo, last);
            EXPECT_GT(seam.differing, 0);
        }
    }
}

TEST(CoordinatorSeams, AreTheSameWhateverTheOrder) {
    constexpr Rect region{0, 0, 90, 80};
    for (const Shape shape : {Shape::columns, Shape::tiles}) {
        std::set<std::string> results;
        std::set<std::vector<int>> orders;
        for (unsigned seed = 1; seed <= 40; ++seed) {
            // Every launch has other pixels everywhere: whatever is placed in another order shows.
            RigSetup setup = halo_setup(region, shape, 5, 1000);
            setup.seed = seed;
            setup.workers = 1 + static_cast<int>(seed % 5);
            setup.policy = seed % 2 == 0 ? Policy::static_ : Policy::dynamic;
            Rig rig(setup);
            rig.run();
            results.insert(rig.canvas().sha1());
            std::vector<int> order;
            for (const SectionRecord& repair : rig.record().repairs)
                order.push_back(repair.section.keep.x0);
            orders.insert(order);
        }
        EXPECT_EQ(results.size(), 1u);
        EXPECT_GT(orders.size(), 1u) << "the orders were all the same: nothing was tested";
    }
}

TEST(CoordinatorSeams, AFailedRepairLeavesNoTrace) {
    constexpr Rect region{0, 0, 200, 20};
    RigSetup setup = halo_setup(region, Shape::columns, 3, 2);
    setup.worker.fault = [](int, const Assignment& a) {
        return a.section.id >= 3 && a.attempt == 1 ? std::string("no memory") : std::string();
    };
    Rig rig(setup);
    rig.run();
    EXPECT_TRUE(holds_known_picture(rig.canvas(), region));
    const RunRecord record = rig.record();
    EXPECT_EQ(record.totals.launches, 3 + 2 * 2);
    EXPECT_EQ(record.totals.retries, 2);
    for (const SeamRecord& seam : record.seams) EXPECT_EQ(seam.halo, 4);
}

nlohmann::json earlier(int attempts = 1) {
    return {{"rank", 0},           {"host", "then"},     {"start", 1.0},        {"end", 2.0},
            {"wall_seconds", 1.0}, {"cpu_seconds", 0.5}, {"attempts", attempts}};
}

TEST(CoordinatorResume, RendersOnlyWhatIsMissing) {
    constexpr Rect region{0, 0, 60, 12};
    for (const Policy policy : {Policy::static_, Policy::dynamic}) {
        RigSetup setup = halo_setup(region, Shape::columns, 6, 0);
        setup.policy = policy;
        Rig rig(setup);
        for (const Section& section : make_partition(setup.grid).sections)
            if (section.id % 2 == 0)
                rig.coordinator().resume(section.id, earlier(), known_pixels(section.render));
        EXPECT_EQ(rig.coordinator().sections_done(), 3);
        EXPECT_DOUBLE_EQ(rig.coordinator().fraction(), 0.5);
        EXPECT_EQ(rig.ranks().waiting(), 0u) << "nothing may be sent before start()";
        rig.run();
        EXPECT_TRUE(holds_known_picture(rig.canvas(), region));
        const RunRecord record = rig.record();
        EXPECT_EQ(record.totals.launches, 3);
        for (const SectionRecord& section : record.sections) {
            EXPECT_EQ(section.resumed, section.section.id % 2 == 0);
            EXPECT_EQ(section.host == "then", section.resumed);
        }
        for (const SeamRecord& seam : record.seams) EXPECT_TRUE(seam.checked);
    }
}

TEST(CoordinatorResume, OfEverythingIsFinishedAtOnce) {
    const RigSetup setup = halo_setup({0, 0, 60, 12}, Shape::columns, 4, 0);
    Rig rig(setup);
    for (const Section& section : make_partition(setup.grid).sections)
        rig.coordinator().resume(section.id, earlier(), known_pixels(section.render));
    EXPECT_TRUE(rig.coordinator().finished());
    rig.run();
    EXPECT_EQ(rig.record().totals.launches, 0);
}

// Both sides of a seam were finished before, and disagree: it is rendered again, by workers that
// know the job by then.
TEST(CoordinatorResume, StillChecksTheSeams) {
    constexpr Rect region{0, 0, 180, 12};
    const RigSetup setup = halo_setup(region, Shape::columns, 3, 3);
    const auto render = wrong_near_edges(3, region);
    for (const int resumed : {2, 3}) {
        Rig rig(setup);
        for (const Section& section : make_partition(setup.grid).sections)
            if (section.id < resumed)
                rig.coordinator().resume(section.id, earlier(), render(section.render));
        EXPECT_EQ(rig.ranks().waiting(), 0u) << "nothing may be sent before start()";
        rig.run();
        EXPECT_TRUE(holds_known_picture(rig.canvas(), region));
        EXPECT_EQ(rig.record().totals.launches, 3 - resumed + 2 * 2);
        for (const SeamRecord& seam : rig.record().seams) EXPECT_EQ(seam.halo, 8);
    }
}

TEST(CoordinatorResume, GoesOnFromTheJournalOfARunThatFailed) {
    constexpr Rect region{0, 0, 180, 12};
    const ScratchFolder scratch("coordinator-test");
    const nlohmann::json identity{{"scene", "s"}};
    RigSetup setup = halo_setup(region, Shape::columns, 6, 2);
    setup.retries = 0;
    setup.in_flight = 1;
    setup.workers = 1;
    setup.worker.fault = [](int, const Assignment& a) {
        return a.section.id == 4 ? std::string("no memory") : std::string();
    };
    {
        Journal journal = Journal::create(scratch.path() / "work", identity, {});
        setup.journal = &journal;
        Rig rig(setup);
        EXPECT_THROW(rig.run(), Failure);
    }
    Journal journal = Journal::open(scratch.path() / "work", identity);
    setup.journal = &journal;
    setup.worker.fault = FakeWorkerSetup{}.fault;
    Rig rig(setup);
    const std::vector<Journal::Finished> finished =
        journal.finished([&](int section) { return rig.coordinator().bytes_of(section); });
    EXPECT_EQ(finished.size(), 4u);
    for (const Journal::Finished& f : finished)
        rig.coordinator().resume(f.section, f.about, journal.read(f.section));
    rig.run();
    EXPECT_TRUE(holds_known_picture(rig.canvas(), region));
    for (const Assignment& a : rig.workers()[0].assignments())
        EXPECT_GE(a.section.id, 4) << "a finished section was rendered again";
}

TEST(CoordinatorResume, RefusesPixelsOfAnotherSize) {
    Rig rig(halo_setup({0, 0, 60, 12}, Shape::columns, 3, 0));
    const std::vector<std::byte> little(17);
    EXPECT_THROW(rig.coordinator().resume(0, earlier(), little), std::exception);
    EXPECT_THROW(rig.coordinator().resume(3, earlier(), little), std::exception);
    EXPECT_EQ(rig.coordinator().sections_done(), 0);
}

}  // namespace
}  // namespace mpipov
