#include "event_loop.h"

#include "coordinator_test_support.h"
#include "cpu_time.h"
#include "failure.h"
#include "fake_povray_test_support.h"
#include "interrupt.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace mpipov {
namespace {

using testing::HasSubstr;

constexpr Rect frame{0, 0, 64, 48};

// Where a build measures no times.
#ifdef __SANITIZE_ADDRESS__
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

// Rank 0 with a coordinator, in the test's thread; the other ranks in threads of their own. All of
// them launch the stand-in for POV-Ray.
class EventLoopTest : public FakePovrayTest {
  protected:
    static CoordinatorSetup setup(int ranks, int sections) {
        CoordinatorSetup c = launching_setup(frame, ranks, sections);
        c.timeout_seconds = 60;
        return c;
    }

    // Until the image is finished, or whatever `coordinator` or `every_step` throw.
    RunRecord run(CoordinatorSetup c, const std::function<void()>& every_step = {}) {
        const int size = static_cast<int>(c.ranks.size());
        InProcessRanks ranks(size);
        Canvas canvas({frame.width(), frame.height(), known_channels, Depth::uint8});
        Coordinator coordinator(std::move(c), ranks.at(0), canvas, nullptr, steady_seconds);
        std::vector<std::jthread> threads;
        for (int rank = 1; rank < size; ++rank)
            threads.emplace_back([&, rank] {
                const ScratchFolder scratch("protocol-test");
                Worker worker(ranks.at(rank), scratch.path());
                run_event_loop({ranks.at(rank), worker});
            });
        Worker worker(ranks.at(0), scratch_.path());
        try {
            coordinator.start();
            run_event_loop({ranks.at(0), worker, &coordinator, every_step});
        } catch (...) {
            worker.stop();
            send_stops(ranks.at(0));
            throw;
        }
        send_stops(ranks.at(0));
        threads.clear();
        // A rank whose launch lost may have said that it is gone when nobody looked any more.
        RunRecord record;
        coordinator.fill(record);
        if (record.totals.copies == 0) {
            EXPECT_EQ(ranks.waiting(), 0u);
        }
        EXPECT_TRUE(holds_known_picture(canvas, frame));
        return record;
    }
};

TEST_F(EventLoopTest, RendersAlone) {
    const RunRecord record = run(setup(1, 3));
    EXPECT_EQ(record.totals.launches, 3);
    EXPECT_EQ(record.ranks[0].sections, 3);
}

TEST_F(EventLoopTest, RendersOnSeveralRanks) {
    CoordinatorSetup c = setup(3, 12);
    c.in_flight = {2, 2, 2};
    const RunRecord record = run(c);
    EXPECT_EQ(record.totals.launches, 12);
    for (const RankRecord& rank : record.ranks) EXPECT_GT(rank.sections, 0);
    for (const SeamRecord& seam : record.seams) EXPECT_TRUE(seam.checked);
}

TEST_F(EventLoopTest, ADedicatedCoordinatorRendersNothing) {
    CoordinatorSetup c = setup(3, 6);
    c.ranks[0].slots = 0;
    const RunRecord record = run(c);
    EXPECT_EQ(record.ranks[0].sections, 0);
    EXPECT_EQ(record.totals.launches, 6);
}

TEST_F(EventLoopTest, GoesOnAfterEveryKindOfFault) {
    for (const std::string fault : {"error", "crash", "no-file", "truncated", "wrong-size"}) {
        const Environment what("FAKE_POVRAY", fault),
            once("FAKE_POVRAY_ONCE", (elsewhere_.path() / fault).string());
        const RunRecord record = run(setup(2, 4));
        EXPECT_EQ(record.totals.retries, 1) << fault;
        EXPECT_EQ(record.totals.launches, 5) << fault;
    }
}

TEST_F(EventLoopTest, ACopyEndsWhatWouldHang) {
    const Environment what("FAKE_POVRAY", "hang"),
        once("FAKE_POVRAY_ONCE", (elsewhere_.path() / "hang").string());
    const RunRecord record = run(setup(2, 4));  // a hung launch would else hold it up for a minute
    EXPECT_EQ(record.totals.copies, 1);
    EXPECT_EQ(record.totals.launches, 5);
    EXPECT_EQ(record.totals.retries, 0);
}

TEST_F(EventLoopTest, EndsWithPovraysErrorWhereASectionAlwaysFails) {
    const Environment fault("FAKE_POVRAY", "error"), column("FAKE_POVRAY_COLUMN", "31");
    try {
        run(setup(2, 2));
        FAIL() << "it went through";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), Exit::scene);
        EXPECT_THAT(failure.what(), HasSubstr("Undeclared identifier"));
        EXPECT_THAT(failure.what(), HasSubstr("3 times"));
    }
}

TEST_F(EventLoopTest, ARankThatRefusesEndsTheRun) {
    InProcessRanks ranks(2);
    Canvas canvas({frame.width(), frame.height(), known_channels, Depth::uint8});
    Coordinator coordinator(setup(2, 2), ranks.at(0), canvas, nullptr, steady_seconds);
    Worker worker(ranks.at(0), scratch_.path());
    ranks.at(1).send({MessageKind::refused, 0, {{"code", 5}, {"why", "interrupted"}}, {}});
    try {
        run_event_loop({ranks.at(0), worker, &coordinator});
        FAIL() << "it went on";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), Exit::interrupted);
        EXPECT_STREQ(failure.what(), "interrupted");
    }
}

// SIGTERM stays pending while it lives, without ending the test.
class PendingSignal {
  public:
    PendingSignal() {
        pthread_sigmask(SIG_SETMASK, nullptr, &before_);
        block_interrupts();
    }
    PendingSignal(const PendingSignal&) = delete;
    PendingSignal& operator=(const PendingSignal&) = delete;
    ~PendingSignal() {
        sigset_t term{};
        sigemptyset(&term);
        sigaddset(&term, SIGTERM);
        const timespec at_once{};
        EXPECT_EQ(sigtimedwait(&term, nullptr, &at_once), SIGTERM);
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }

  private:
    sigset_t before_{};
};

TEST_F(EventLoopTest, ASignalEndsTheLaunches) {
    const PendingSignal signal;
    const Environment fault = faults("hang");
    const double begin = steady_seconds();
    int steps = 0;
    try {
        run(setup(1, 2), [&] {
            if (++steps == 5) std::raise(SIGTERM);
        });
        ADD_FAILURE() << "it went on";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), Exit::interrupted);
    }
    EXPECT_LT(steady_seconds() - begin, 20) << "a launch that hangs has held it up";
}

TEST_F(EventLoopTest, ASignalEndsTheWaitForAMessage) {
    const PendingSignal signal;
    InProcessRanks ranks(2);
    const double begin = steady_seconds();
    std::jthread later([] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        ::kill(::getpid(), SIGTERM);
    });
    EXPECT_FALSE(wait_for_message(ranks.at(0), 60));
    EXPECT_FALSE(wait_for_message(ranks.at(0), 60, 0.1));
    EXPECT_LT(steady_seconds() - begin, 20);
    // What is there is taken all the same.
    ranks.at(1).send({MessageKind::bye, 0, nlohmann::json::object(), {}});
    EXPECT_TRUE(wait_for_message(ranks.at(0), 60));
}

TEST_F(EventLoopTest, PassesOnWhatAStepThrows) {
    int steps = 0;
    const auto every_step = [&] {
        if (++steps == 3) throw std::runtime_error("the third step");
    };
    const Environment fault = faults("hang");
    EXPECT_THROW(run(setup(1, 2), every_step), std::runtime_error);
    EXPECT_EQ(steps, 3);
}

// Waiting must not use the core that a launch on this host needs.
TEST_F(EventLoopTest, SleepsWhileItWaits) {
    constexpr double watched_seconds = 2;
    for (const bool launched : {false, true}) {
        const Environment fault = faults("hang");
        InProcessRanks ranks(2);
        Canvas canvas({frame.width(), frame.height(), known_channels, Depth::uint8});
        CoordinatorSetup c = setup(2, 1);
        c.ranks[launched ? 1 : 0].slots = 0;
        Coordinator coordinator(std::move(c), ranks.at(0), canvas, nullptr, steady_seconds);
        Worker worker(ranks.at(0), scratch_.path());
        coordinator.start();
        double began = 0, cpu = 0;
        int wakes = 0;
        const auto every_step = [&] {
            while (ranks.at(1).try_receive()) continue;
            if (began == 0 && ranks.waiting() == 0) {
                began = steady_seconds();
                cpu = own_cpu_seconds(RUSAGE_THREAD);
                wakes = 0;
            }
            ++wakes;
            if (began > 0 && steady_seconds() - began > watched_seconds)
                throw std::runtime_error("enough");
        };
        EXPECT_THROW(run_event_loop({ranks.at(0), worker, &coordinator, every_step}),
                     std::runtime_error);
        const double busy = (own_cpu_seconds(RUSAGE_THREAD) - cpu) / watched_seconds;
        const char* when = launched ? "with_a_launch" : "without_a_launch";
        EXPECT_LT(wakes / watched_seconds, 50) << when;
        if (!sanitized) {
            EXPECT_LT(busy, 0.01) << when;
        }
        RecordProperty(fmt::format("percent_{}", when), fmt::format("{:.2f}", busy * 100));
        worker.stop();
    }
}

TEST(WaitForMessage, ReturnsTheMessageOrNothingInTime) {
    InProcessRanks ranks(2);
    const double begin = steady_seconds();
    EXPECT_FALSE(wait_for_message(ranks.at(0), 0.05));
    EXPECT_GE(steady_seconds() - begin, 0.05);
    ranks.at(1).send({MessageKind::hello, 0, {{"slots", 4}}, {}});
    const auto message = wait_for_message(ranks.at(0), 60);
    ASSERT_TRUE(message);
    EXPECT_EQ(message->kind, MessageKind::hello);
    EXPECT_EQ(message->peer, 1);
    EXPECT_EQ(message->head.at("slots"), 4);
}

}  // namespace
}  // namespace mpipov
