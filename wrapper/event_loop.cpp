#include "event_loop.h"

#include "failure.h"
#include "heartbeat.h"
#include "interrupt.h"
#include "message_fields.h"

#include <fmt/format.h>
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

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

// Who is there, and that we are.
class Watch {
  public:
    explicit Watch(const EventLoop& loop)
        : loop_(loop), beat_(loop.transport.size(), loop.lost_after_seconds) {
        if (!is_rank_0() || loop.lost_after_seconds <= 0) return;
        for (int peer = 1; peer < loop.transport.size(); ++peer) beat_.watch(peer, seconds_now());
        on_ = true;
    }

    void heard(const Message& message) {
        beat_.heard(message.peer, seconds_now());
        if (message.kind != MessageKind::alive || is_rank_0()) return;
        const auto within = MessageFields(message.head).seconds_or_none("again_within");
        on_ = within.has_value();
        if (on_) {
            beat_ = Heartbeat(loop_.transport.size(), *within);
            beat_.watch(message.peer, seconds_now(), *within);
            say(0, {});
        } else {
            beat_.ignore(message.peer);
        }
    }

    void step() {
        if (!on_) return;
        const double now = seconds_now();
        if (is_rank_0() && beat_.due(now)) say_to_all(loop_.lost_after_seconds);
        if (const auto peer = beat_.lost(now))
            throw Failure(Exit::interrupted, silence_of(*peer), true);
    }

    // Rank 0 has other things to do now, and need not be watched.
    void end() const {
        if (on_ && is_rank_0()) say_to_all({});
    }

  private:
    bool is_rank_0() const { return loop_.coordinator != nullptr; }

    void say(int peer, std::optional<double> again_within) const {
        loop_.transport.send(
            {MessageKind::alive,
             peer,
             {{"again_within", again_within ? nlohmann::json(*again_within) : nlohmann::json()}},
             {}});
    }
    void say_to_all(std::optional<double> again_within) const {
        for (int peer = 1; peer < loop_.transport.size(); ++peer) say(peer, again_within);
    }
    std::string silence_of(int peer) const {
        const std::string who =
            is_rank_0() ? fmt::format("host {} (rank {})", loop_.coordinator->host(peer), peer)
                        : std::string("rank 0");
        return fmt::format("{} was not heard of for {:.0f} s (--lost-after)", who,
                           beat_.lost_after_seconds());
    }

    const EventLoop& loop_;
    Heartbeat beat_;
    bool on_ = false;
};

void dispatch(const EventLoop& loop, const Message& message) {
    if (message.kind == MessageKind::alive) return;
    if (is_for_worker(message.kind)) {
        loop.worker.handle(message);
    } else if (message.kind == MessageKind::refused) {
        const MessageFields fields(message.head);
        const Exit code = fields.code("code");
        const std::string why = fields.said("why");
        // Whoever is interrupted, all are.
        throw Failure(code, code == Exit::interrupted
                                ? why
                                : fmt::format("host {}: {}", fields.text("host"), why));
    } else if (loop.coordinator != nullptr) {
        loop.coordinator->handle(message);
    }
}

}  // namespace

void run_event_loop(const EventLoop& loop) {
    const int longest = loop.transport.size() > 1 ? longest_sleep_ms : longest_sleep_alone_ms;
    int sleep_ms = shortest_sleep_ms;
    std::vector<pollfd> fds;
    Watch watch(loop);
    for (;;) {
        if (interrupted()) {
            loop.worker.stop();
            throw_if_interrupted();
        }
        bool busy = loop.worker.step();
        while (auto message = loop.transport.try_receive()) {
            watch.heard(*message);
            dispatch(loop, *message);
            busy = true;
        }
        try {
            watch.step();
        } catch (const Failure&) {
            loop.worker.stop();
            throw;
        }
        if (loop.coordinator != nullptr) loop.coordinator->tick();
        if (loop.every_step) loop.every_step();
        if (loop.coordinator != nullptr ? loop.coordinator->finished() : loop.worker.stopped()) {
            watch.end();
            return;
        }
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
