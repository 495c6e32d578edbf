#include "gather.h"

#include "event_loop.h"
#include "failure.h"
#include "fake_povray_test_support.h"
#include "in_process_transport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <thread>

namespace mpipov {
namespace {

using testing::HasSubstr;

constexpr ImageSize image{64, 48};

// Rank 0 gathers in the test's thread, with the other ranks in threads of their own. All of them
// launch the stand-in for POV-Ray, whose samples say how many there were before.
class GatherTest : public FakePovrayTest {
  protected:
    static GatherSetup setup(int ranks, const RadiositySharing& sharing, int sections = 6) {
        GatherSetup setup;
        setup.job.job = fake_job(image);
        for (int rank = 0; rank < ranks; ++rank) setup.job.ranks.push_back({rank, "host", 1, 0, 0});
        setup.job.in_flight.assign(setup.job.ranks.size(), 2);
        setup.waves = gather_waves(
            sharing, image,
            make_partition({{0, 0, 64, 48}, Shape::columns, Seams::plain, sections, 0, 32}));
        setup.timeout_seconds = 60;
        return setup;
    }

    std::string gather(const GatherSetup& setup, Journal* journal = nullptr,
                       const std::function<void(int)>& at_wave = {}) {
        std::vector<RankRecord> of_ranks = setup.job.ranks;
        InProcessRanks ranks(static_cast<int>(of_ranks.size()));
        std::vector<std::jthread> threads;
        for (int rank = 1; rank < static_cast<int>(of_ranks.size()); ++rank)
            threads.emplace_back([&, rank] {
                const ScratchFolder scratch("protocol-test");
                Worker worker(ranks.at(rank), scratch.path());
                run_event_loop({ranks.at(rank), worker});
            });
        const ScratchFolder scratch("protocol-test");
        Worker worker(ranks.at(0), scratch.path());
        record_ = {};
        const auto progress = [&](int wave, double fraction) {
            EXPECT_GE(fraction, 0);
            EXPECT_LE(fraction, 1);
            if (at_wave) at_wave(wave);
        };
        try {
            const std::string cache = gather_radiosity(
                setup, {ranks.at(0), worker, journal, [] { return 0.0; }, progress}, record_,
                of_ranks);
            send_stops(ranks.at(0));
            return cache;
        } catch (...) {
            worker.stop();
            send_stops(ranks.at(0));
            throw;
        }
    }

    RunRecord record_;
};

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

TEST_F(GatherTest, IsTheSameForAnyNumberOfRanks) {
    std::set<std::string> caches;
    for (const int ranks : {1, 2, 3}) caches.insert(gather(setup(ranks, {Sharing::joined, 2, 1})));
    ASSERT_EQ(caches.size(), 1U);
    // One that all of them take, and one of each of 6 sections in a coarse and a fine pass.
    EXPECT_EQ(lines_of(*caches.begin()).size(), 13U);
}

TEST_F(GatherTest, AWaveReadsWhatEarlierOnesJoined) {
    const std::vector<std::string> lines = lines_of(gather(setup(2, {Sharing::joined, 1, 1})));
    ASSERT_EQ(lines.size(), 7U);
    for (const int section : {1, 2, 3})
        EXPECT_THAT(lines[section], HasSubstr("\t48\t0\t0")) << section;
    for (const int section : {4, 5, 6})
        EXPECT_THAT(lines[section], HasSubstr("\t48\t4\t0")) << section;
}

TEST_F(GatherTest, IsRecorded) {
    gather(setup(2, {Sharing::joined, 1, 2}));
    ASSERT_EQ(record_.waves.size(), 2U);
    EXPECT_EQ(record_.waves[0].width, 32);
    EXPECT_EQ(record_.waves[0].height, 24);
    EXPECT_EQ(record_.waves[0].samples, 4);
    EXPECT_EQ(record_.waves[1].samples, 7);
    EXPECT_EQ(record_.waves[0].sections.size(), 3U);
    EXPECT_EQ(record_.totals.launches, 6);
}

TEST_F(GatherTest, GoesOnAfterAFault) {
    const std::string expected = gather(setup(2, {Sharing::joined, 1, 1}));
    const Environment what("FAKE_POVRAY", "crash"),
        once("FAKE_POVRAY_ONCE", (elsewhere_.path() / "crash").string());
    EXPECT_EQ(gather(setup(2, {Sharing::joined, 1, 1})), expected);
    EXPECT_EQ(record_.totals.retries, 1);
}

TEST_F(GatherTest, SaysInWhichWaveItFailed) {
    const Environment what("FAKE_POVRAY", "error");
    try {
        gather(setup(1, {Sharing::joined, 1, 2}));
        FAIL();
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), Exit::scene);
        EXPECT_THAT(failure.what(), HasSubstr("wave 1 of 2 (32 x 24 pixels): section"));
    }
}

TEST_F(GatherTest, BeginsWithWhatTheProbeTook) {
    GatherSetup with_first = setup(1, {Sharing::joined, 1, 1});
    with_first.first = "C3\t0\t0\t0\t0\t0\t0\t0\t0\t0\t0\n";
    const std::vector<std::string> lines = lines_of(gather(with_first));
    ASSERT_EQ(lines.size(), 8U);
    EXPECT_THAT(lines[2], HasSubstr("\t48\t1\t0"));
}

TEST_F(GatherTest, GoesOnFromTheWaveThatTheJournalKept) {
    const nlohmann::json nothing = nlohmann::json::object();
    const std::string expected = gather(setup(2, {Sharing::joined, 2, 1}));
    Journal journal = Journal::create(elsewhere_.path() / "journal", nothing, nothing);
    const auto interrupt = [](int wave) {
        if (wave == 2) throw std::runtime_error("on purpose");
    };
    EXPECT_THROW(gather(setup(2, {Sharing::joined, 2, 1}), &journal, interrupt),
                 std::runtime_error);
    EXPECT_EQ(journal.cache().waves, 2);
    EXPECT_EQ(gather(setup(1, {Sharing::joined, 2, 1}), &journal), expected);
    EXPECT_EQ(record_.waves.size(), 1U);
    EXPECT_EQ(record_.totals.launches, 3);
}

}  // namespace
}  // namespace mpipov
