#include "event_loop.h"

#include "failure.h"
#include "interrupt.h"

#include <poll.h>

#include <algorithm>
#include <chrono>
#include <vector>

namespace mpipov {
namespace {

// A rank that only waits for messages wakes 40 times a second: well under one percent of a core.
constexpr int shortest_sleep_ms = 1, longest_sleep_ms = 25;
// Nothing but a child's end, which ends the sleep, can happen to a rank that is alone.
constexpr int longest_sleep_alone_ms = 100;

// Of a cache that is sent to be read, not of samples that a section has taken.
bool is_for_worker(const Message& message) {
    const MessageKind kind = message.kind;
    return kind == MessageKind::job || kind == MessageKind::assign || kind == MessageKind::cancel ||
           kind == MessageKind::stop || kind == MessageKind::look || kind == MessageKind::pack ||
           kind == MessageKind::piece ||
           (kind == MessageKind::cache && !message.head.contains("section"));
}

void dispatch(const EventLoop& loop, const Message& message) {
    if (is_for_worker(message)) {
        loop.worker.handle(message);
    } else if (message.kind == MessageKind::refused) {
        throw Failure(static_cast<Exit>(message.head.at("code").get<int>()),
                      message.head.at("why").get<std::string>());
    } else if (loop.coordinator != nullptr) {
        loop.coordinator->handle(message);
    }
}

}  // namespace

void run_event_loop(const EventLoop& loop) {
    const int longest = loop.transport.size() > 1 ? longest_sleep_ms : longest_sleep_alone_ms;
    int sleep_ms = shortest_sleep_ms;
    std::vector<pollfd> fds;
    for (;;) {
        if (interrupted()) {
            loop.worker.stop();
            throw_if_interrupted();
        }
        bool busy = loop.worker.step();
        while (auto message = loop.transport.try_receive()) {
            dispatch(loop, *message);
            busy = true;
        }
        if (loop.coordinator != nullptr) loop.coordinator->tick();
        if (loop.every_step) loop.every_step();
        if (loop.coordinator != nullptr ? loop.coordinator->finished() : loop.worker.stopped())
            return;
        if (busy) {
            sleep_ms = shortest_sleep_ms;
            continue;
        }
        const int most = loop.transport.unsent_bytes() > 0 ? shortest_sleep_ms : sleep_ms;
        sleep_ms = std::min(sleep_ms * 2, longest);
        fds.clear();
        loop.worker.add_poll_fds(fds);
        ::poll(fds.data(), fds.size(), loop.worker.wait_milliseconds(most));
    }
}

void send_stops(Transport& transport) {
    for (int rank = 1; rank < transport.size(); ++rank)
        transport.send({MessageKind::stop, rank, nlohmann::json::object(), {}});
}

std::optional<Message> wait_for_message(Transport& transport, double seconds,
                                        double seconds_after_signal) {
    using Seconds = std::chrono::duration<double>;
    const auto begin = std::chrono::steady_clock::now();
    for (;;) {
        if (auto message = transport.try_receive()) return message;
        const double most = interrupted() ? std::min(seconds, seconds_after_signal) : seconds;
        if (Seconds(std::chrono::steady_clock::now() - begin).count() >= most) return {};
        ::poll(nullptr, 0, 2);
    }
}

}  // namespace mpipov
