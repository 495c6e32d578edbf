// Ranks within one process, for tests of the protocol: every message is packed and unpacked as over
// MPI, waits in a queue of its pair of ranks, and is taken by try_receive(). Within a pair the
// order is kept; between pairs it is that of sending, or with a seed any, the same for the same
// seed and calls. Ranks may live in threads of their own.
#pragma once

#include "transport.h"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

namespace mpipov {

class InProcessRanks {
  public:
    explicit InProcessRanks(int size, std::optional<unsigned> seed = {})
        : size_(size), shuffled_(seed.has_value()), random_(seed.value_or(0)) {
        inboxes_.resize(static_cast<std::size_t>(size));
        for (Inbox& inbox : inboxes_) inbox.from.resize(static_cast<std::size_t>(size));
        for (int rank = 0; rank < size; ++rank)
            ranks_.push_back(std::make_unique<Rank>(*this, rank));
    }
    InProcessRanks(const InProcessRanks&) = delete;
    InProcessRanks& operator=(const InProcessRanks&) = delete;

    Transport& at(int rank) { return *ranks_.at(static_cast<std::size_t>(rank)); }

    // Messages that were sent and not received.
    std::size_t waiting() {
        const std::scoped_lock lock(mutex_);
        std::size_t count = 0;
        for (const Inbox& inbox : inboxes_)
            for (const auto& queue : inbox.from) count += queue.size();
        return count;
    }

  private:
    struct Letter {
        long long number = 0;  // in the order of sending
        std::vector<std::byte> bytes;
    };
    struct Inbox {
        std::vector<std::deque<Letter>> from;  // by sender
    };

    class Rank : public Transport {
      public:
        Rank(InProcessRanks& all, int rank) : all_(all), rank_(rank) {}
        int rank() const override { return rank_; }
        int size() const override { return all_.size_; }
        void send(Message message) override { all_.send(rank_, message); }
        std::optional<Message> try_receive() override { return all_.receive(rank_); }
        std::size_t unsent_bytes() override { return all_.unsent(rank_); }

      private:
        InProcessRanks& all_;
        int rank_;
    };

    void send(int from, const Message& message) {
        Letter letter{0, pack(message)};
        const std::scoped_lock lock(mutex_);
        letter.number = sent_++;
        inboxes_.at(static_cast<std::size_t>(message.peer))
            .from[static_cast<std::size_t>(from)]
            .push_back(std::move(letter));
    }

    std::optional<Message> receive(int rank) {
        const std::scoped_lock lock(mutex_);
        Inbox& inbox = inboxes_[static_cast<std::size_t>(rank)];
        std::vector<std::size_t> senders;
        for (std::size_t from = 0; from < inbox.from.size(); ++from)
            if (!inbox.from[from].empty()) senders.push_back(from);
        if (senders.empty()) return {};
        const auto first_sent = [&](std::size_t a, std::size_t b) {
            return inbox.from[a].front().number < inbox.from[b].front().number;
        };
        const std::size_t from = shuffled_ ? senders[random_() % senders.size()]
                                           : *std::ranges::min_element(senders, first_sent);
        const Letter letter = std::move(inbox.from[from].front());
        inbox.from[from].pop_front();
        return unpack(letter.bytes, static_cast<int>(from));
    }

    // What others have not taken yet; as over MPI, a rank's words to itself do not count.
    std::size_t unsent(int rank) {
        const std::scoped_lock lock(mutex_);
        std::size_t bytes = 0;
        for (std::size_t to = 0; to < inboxes_.size(); ++to)
            if (static_cast<int>(to) != rank)
                for (const Letter& letter : inboxes_[to].from[static_cast<std::size_t>(rank)])
                    bytes += letter.bytes.size();
        return bytes;
    }

    int size_;
    bool shuffled_;
    std::mt19937 random_;
    std::mutex mutex_;
    long long sent_ = 0;
    std::vector<Inbox> inboxes_;
    std::vector<std::unique_ptr<Rank>> ranks_;
};

}  // namespace mpipov
