// A coordinator and its fake workers in one process, run to the end in an order of events that a
// seed chooses.
#pragma once

#include "coordinator.h"
#include "fake_worker.h"
#include "in_process_transport.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace mpipov {

struct RigSetup {
    GridRequest grid;
    Policy policy = Policy::dynamic;
    int workers = 2;
    bool dedicated_coordinator = false;
    int in_flight = 1;
    int retries = 2;
    int widest_halo = 32;
    bool copies = false;                      // whether idle ranks copy the last sections
    double clock_step = 0.001;                // seconds, each time that somebody looks
    std::function<double()> clock_jump = {};  // seconds besides, each time; empty: none
    FakeWorkerSetup worker = {};
    unsigned seed = 1;
    std::string cache = {};
    bool gathers = false;
    Journal* journal = nullptr;
    int frame_width = 0, frame_height = 0;  // 0: the region ends where the frame does
};

class Rig {
  public:
    explicit Rig(const RigSetup& setup)
        : random_(setup.seed),
          ranks_(setup.workers, setup.seed),
          canvas_({setup.frame_width > 0 ? setup.frame_width : setup.grid.region.x1,
                   setup.frame_height > 0 ? setup.frame_height : setup.grid.region.y1,
                   known_channels, Depth::uint8}),
          coordinator_(coordinator_setup(setup, canvas_), ranks_.at(0), canvas_, setup.journal,
                       [this, setup] {
                           if (setup.clock_jump) now_ += setup.clock_jump();
                           return now_ += setup.clock_step;
                       }) {
        for (int rank = 0; rank < setup.workers; ++rank)
            workers_.emplace_back(ranks_.at(rank), setup.worker);
    }

    // Everything up to the placed repairs; throws what the coordinator throws.
    void run() {
        coordinator_.start();
        while (!coordinator_.finished()) step();
        EXPECT_EQ(coordinator_.fraction(), 1);
        EXPECT_EQ(coordinator_.sections_done(), coordinator_.sections_total());
        coordinator_.place_repairs();
    }

    // One rank, any, receives one message or sends one.
    void step() {
        const auto rank = static_cast<int>(random_() % workers_.size());
        FakeWorker& worker = workers_[static_cast<std::size_t>(rank)];
        coordinator_.tick();
        if (random_() % 2 == 0) return worker.step(random_);
        const auto message = ranks_.at(rank).try_receive();
        if (!message) return;
        if (is_for_worker(message->kind)) return worker.handle(*message);
        const double before = coordinator_.fraction();
        coordinator_.handle(*message);
        EXPECT_GE(coordinator_.fraction(), before);
        EXPECT_LE(coordinator_.fraction(), 1);
    }

    Coordinator& coordinator() { return coordinator_; }
    InProcessRanks& ranks() { return ranks_; }
    const Canvas& canvas() const { return canvas_; }
    const std::vector<FakeWorker>& workers() const { return workers_; }
    RunRecord record() const {
        RunRecord record;
        coordinator_.fill(record);
        return record;
    }

  private:
    static CoordinatorSetup coordinator_setup(const RigSetup& setup, const Canvas& canvas) {
        CoordinatorSetup c;
        c.partition = make_partition(setup.grid);
        c.policy = setup.policy;
        c.image = {canvas.layout().width, canvas.layout().height};
        for (int rank = 0; rank < setup.workers; ++rank)
            c.ranks.push_back({rank, fmt::format("host{}", rank), 1, 0, 0});
        if (setup.dedicated_coordinator) c.ranks[0].slots = 0;
        c.in_flight.assign(static_cast<std::size_t>(setup.workers), setup.in_flight);
        c.cache = setup.cache;
        c.gathers = setup.gathers;
        c.retries = setup.retries;
        c.widest_halo = setup.widest_halo;
        c.copies_every_seconds = setup.copies ? 0 : 1e9;
        return c;
    }

    std::mt19937 random_;
    double now_ = 0;
    InProcessRanks ranks_;
    Canvas canvas_;
    Coordinator coordinator_;
    std::vector<FakeWorker> workers_;
};

// The known picture in `region`, zeros outside, nothing else.
inline testing::AssertionResult holds_known_picture(const Canvas& canvas, const Rect& region) {
    Canvas expected(canvas.layout());
    expected.place(region, known_pixels(region), region);
    const Rect all = canvas.bounds();
    const Difference difference = differing_pixels(canvas, all, expected.read(all), all);
    if (difference.pixels == 0) return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << difference.pixels << " wrong pixels, by up to " << difference.largest;
}

}  // namespace mpipov
