#include "coordinator_test_support.h"
#include "event_loop.h"
#include "failure.h"
#include "fake_povray_test_support.h"

#include <gmock/gmock.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

namespace mpipov {
namespace {

using testing::HasSubstr;

constexpr Rect frame{0, 0, 64, 48};

class LostRankTest : public FakePovrayTest {
  protected:
    static CoordinatorSetup setup(int ranks, int sections) {
        return launching_setup(frame, ranks, sections);
    }
};

// Rank 1 takes its job and is never heard of again.
TEST_F(LostRankTest, ARankThatSaysNothingIsLost) {
    InProcessRanks ranks(2);
    Canvas canvas({frame.width(), frame.height(), known_channels, Depth::uint8});
    CoordinatorSetup c = setup(2, 2);
    c.ranks[1].host = "far";
    c.copies_every_seconds = 1e9;
    Coordinator coordinator(std::move(c), ranks.at(0), canvas, nullptr, steady_seconds);
    Worker worker(ranks.at(0), scratch_.path());
    coordinator.start();
    const double begin = steady_seconds();
    try {
        run_event_loop({ranks.at(0), worker, &coordinator, {}, 1.0});
        FAIL();
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), Exit::interrupted);
        EXPECT_THAT(failure.what(), HasSubstr("host far (rank 1) was not heard of for 1 s"));
    }
    EXPECT_GE(steady_seconds() - begin, 1.0);
    EXPECT_LT(steady_seconds() - begin, 5.0);
}

TEST_F(LostRankTest, AWorkerEndsWhereRankZeroIsLost) {
    InProcessRanks ranks(2);
    Worker worker(ranks.at(1), scratch_.path());
    ranks.at(0).send({MessageKind::alive, 1, {{"again_within", 0.5}}, {}});
    EXPECT_THROW(run_event_loop({ranks.at(1), worker}), Failure);
    EXPECT_TRUE(worker.stopped());
    EXPECT_EQ(ranks.at(0).try_receive()->kind, MessageKind::alive) << "its answer";
}

// While rank 0 has other things to do it says nothing.
TEST_F(LostRankTest, AWorkerWaitsWhereItIsToldTo) {
    InProcessRanks ranks(2);
    Worker worker(ranks.at(1), scratch_.path());
    ranks.at(0).send({MessageKind::alive, 1, {{"again_within", 0.2}}, {}});
    ranks.at(0).send({MessageKind::alive, 1, {{"again_within", nullptr}}, {}});
    const std::jthread stop([&] {
        std::this_thread::sleep_for(std::chrono::seconds(1));
        send_stops(ranks.at(0));
    });
    run_event_loop({ranks.at(1), worker});
}

// A launch takes longer than a rank may be silent.
TEST_F(LostRankTest, RanksThatAreAtWorkAreNotLost) {
    const Environment slow = faults("slow");
    InProcessRanks ranks(3);
    Canvas canvas({frame.width(), frame.height(), known_channels, Depth::uint8});
    Coordinator coordinator(setup(3, 9), ranks.at(0), canvas, nullptr, steady_seconds);
    std::vector<std::jthread> threads;
    for (int rank = 1; rank < 3; ++rank)
        threads.emplace_back([&, rank] {
            const ScratchFolder scratch("protocol-test");
            Worker worker(ranks.at(rank), scratch.path());
            run_event_loop({ranks.at(rank), worker});
        });
    Worker worker(ranks.at(0), scratch_.path());
    coordinator.start();
    run_event_loop({ranks.at(0), worker, &coordinator, {}, 2.0});
    std::this_thread::sleep_for(std::chrono::milliseconds(2500));
    send_stops(ranks.at(0));
    threads.clear();
    EXPECT_TRUE(holds_known_picture(canvas, frame));
}

}  // namespace
}  // namespace mpipov
