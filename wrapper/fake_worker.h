// The worker's half of the protocol without processes and files, for tests of the coordinator:
// "renders" with a function, one message a step, and fails where it is told to.
#pragma once

#include "known_picture.h"
#include "section.h"
#include "transport.h"

#include <algorithm>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mpipov {

struct Assignment {
    Section section;
    int attempt = 0;
};

struct FakeWorkerSetup {
    // The pixels of `render`, row by row.
    std::function<std::vector<std::byte>(const Rect& render)> render = known_pixels;
    // Why the assignment fails on this rank; empty: it does not.
    std::function<std::string(int rank, const Assignment&)> fault = [](int, const Assignment&) {
        return std::string();
    };
    // Whether it never says a word of it.
    std::function<bool(int rank, const Assignment&)> stuck = [](int, const Assignment&) {
        return false;
    };
    int band_rows = 5;
};

class FakeWorker {
  public:
    FakeWorker(Transport& transport, FakeWorkerSetup setup)
        : transport_(transport), setup_(std::move(setup)) {}

    void handle(const Message& message) {
        if (message.kind == MessageKind::job) {
            has_job_ = true;
            gathers_ = message.head.at("gathers");
            expected_ = message.head.at("cache_bytes");
            cache_.clear();
        } else if (message.kind == MessageKind::cache) {
            cache_.append(reinterpret_cast<const char*>(message.body.data()), message.body.size());
        } else if (message.kind == MessageKind::stop) {
            stopped_ = true;
        } else if (message.kind == MessageKind::cancel) {
            const auto found = std::ranges::find_if(launches_, [&](const Launch& launch) {
                return launch.assignment.section.id == message.head.at("section").get<int>() &&
                       launch.assignment.attempt == message.head.at("attempt").get<int>();
            });
            if (found == launches_.end()) return;
            send(*found, MessageKind::cancelled, {{"cpu_seconds", 0.5}});
            launches_.erase(found);
        } else if (message.kind == MessageKind::assign) {
            if (!has_job_) throw std::logic_error("assigned a section before the job was sent");
            if (cache_.size() != expected_)
                throw std::logic_error("assigned a section before its cache was sent");
            const Assignment assignment{
                {message.head.at("section"), rect_from_json(message.head.at("keep")),
                 rect_from_json(message.head.at("render"))},
                message.head.at("attempt")};
            assignments_.push_back(assignment);
            launches_.push_back({assignment, {}, assignment.section.render.y0, false});
            most_in_flight_ = std::max(most_in_flight_, static_cast<int>(launches_.size()));
        } else {
            throw std::logic_error("a message that is not for workers");
        }
    }

    // Sends the next message of one of the launches.
    void step(std::mt19937& random) {
        if (launches_.empty()) return;
        const auto it =
            launches_.begin() + static_cast<std::ptrdiff_t>(random() % launches_.size());
        if (advance(*it)) launches_.erase(it);
    }

    // What gathering a section brings.
    static std::string sample_of(const Rect& render) {
        return "C1\t" + std::to_string(render.x0) + '\t' + std::to_string(render.y0) +
               "\t0\t0\t0\t0\t0\t0\t0\t0\n";
    }

    const std::string& cache() const { return cache_; }
    bool stopped() const { return stopped_; }
    int most_in_flight() const { return most_in_flight_; }
    const std::vector<Assignment>& assignments() const { return assignments_; }

    // What comes ahead of a failure must not be seen in the result.
    static constexpr std::byte garbage{0xee};

  private:
    struct Launch {
        Assignment assignment;
        std::vector<std::byte> pixels;
        int next_row = 0;
        bool reported = false;
    };

    // True after its last message.
    bool advance(Launch& launch) {
        const Rect& render = launch.assignment.section.render;
        if (setup_.stuck(transport_.rank(), launch.assignment)) return false;
        const std::string why = setup_.fault(transport_.rank(), launch.assignment);
        if (!launch.reported) {
            launch.reported = true;
            launch.pixels = setup_.render(render);
            if (!why.empty()) std::ranges::fill(launch.pixels, garbage);
            send(launch, MessageKind::progress, {{"fraction", 0.5}});
            return false;
        }
        // Most faults come after the first band, "at once" before it.
        if (!why.empty() && (launch.next_row > render.y0 || why == "at once")) {
            send(launch, MessageKind::failed,
                 {{"why", why}, {"code", why.starts_with("disk") ? 4 : 3}, {"cpu_seconds", 1.0}});
            return true;
        }
        if (gathers_ && launch.next_row < render.y1) {
            const std::string text = why.empty() ? sample_of(render) : "garbage";
            const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
            // In two pieces, and the section is over.
            const bool first = launch.next_row == render.y0;
            launch.next_row = first ? render.y0 + 1 : render.y1;
            if (render.height() == 1) launch.next_row = render.y1;
            const auto half = render.height() == 1 ? text.size() : text.size() / 2;
            send(launch, MessageKind::samples, nlohmann::json::object(),
                 first ? std::vector<std::byte>(bytes, bytes + half)
                       : std::vector<std::byte>(bytes + half, bytes + text.size()));
            return false;
        }
        if (launch.next_row < render.y1) {
            const int end = std::min(launch.next_row + setup_.band_rows, render.y1);
            const Rect rect{render.x0, launch.next_row, render.x1, end};
            const auto row = static_cast<std::ptrdiff_t>(render.width()) * known_channels;
            const auto from = launch.pixels.begin() + row * (rect.y0 - render.y0);
            send(launch, MessageKind::band, {{"rect", rect_to_json(rect)}},
                 {from, from + row * rect.height()});
            launch.next_row = end;
            return false;
        }
        send(launch, MessageKind::done,
             {{"wall_seconds", 2.0}, {"cpu_seconds", 1.0}, {"warnings", {"the same warning"}}});
        return true;
    }

    void send(const Launch& launch, MessageKind kind, nlohmann::json head,
              std::vector<std::byte> body = {}) {
        head["section"] = launch.assignment.section.id;
        head["attempt"] = launch.assignment.attempt;
        transport_.send({kind, 0, std::move(head), std::move(body)});
    }

    Transport& transport_;
    FakeWorkerSetup setup_;
    bool has_job_ = false, stopped_ = false, gathers_ = false;
    std::string cache_;         // that it was sent
    std::size_t expected_ = 0;  // bytes of it
    int most_in_flight_ = 0;
    std::vector<Launch> launches_;
    std::vector<Assignment> assignments_;
};

}  // namespace mpipov
