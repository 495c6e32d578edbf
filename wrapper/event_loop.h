// The loop that every rank runs: takes messages to where they belong and looks after the launches,
// and sleeps in between (a blocking receive would burn a core).
#pragma once

#include "coordinator.h"
#include "transport.h"
#include "worker.h"

#include <functional>

namespace mpipov {

struct EventLoop {
    Transport& transport;
    Worker& worker;
    Coordinator* coordinator = nullptr;     // on rank 0
    std::function<void()> every_step = {};  // progress; may throw
    // A rank that says nothing for so long is lost; 0: nobody is. Rank 0's holds for all.
    double lost_after_seconds = 0;
};

// Until the coordinator has finished (rank 0) or the worker was told to stop (others). Throws
// Failure(Exit::interrupted) on a signal and where a rank is lost, after the launches were ended,
// and what the coordinator throws. Other ranks watch rank 0 while it is in its loop.
void run_event_loop(const EventLoop& loop);

// Tells every other rank to stop. They end their launches and leave their loops.
void send_stops(Transport& transport);

// Waits for one message outside of the loop, at most `seconds`, and after a signal (interrupt.h) at
// most `seconds_after_signal`.
std::optional<Message> wait_for_message(Transport& transport, double seconds,
                                        double seconds_after_signal = 0);

}  // namespace mpipov
