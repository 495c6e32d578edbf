#include "heartbeat.h"

#include <cstddef>

namespace mpipov {
namespace {

// So many words may come late before one counts as lost.
constexpr double words_within_patience = 6;

}  // namespace

Heartbeat::Heartbeat(int ranks, double lost_after_seconds)
    : peers_(static_cast<std::size_t>(ranks)), lost_after_(lost_after_seconds) {}

void Heartbeat::watch(int peer, double now) {
    watch(peer, now, lost_after_);
}

void Heartbeat::watch(int peer, double now, double seconds) {
    peers_.at(static_cast<std::size_t>(peer)) = {now, seconds, true};
}

void Heartbeat::ignore(int peer) {
    peers_.at(static_cast<std::size_t>(peer)).watched = false;
}

void Heartbeat::heard(int peer, double now) {
    peers_.at(static_cast<std::size_t>(peer)).last = now;
}

bool Heartbeat::due(double now) {
    if (said_ && now - *said_ < lost_after_ / words_within_patience) return false;
    said_ = now;
    return true;
}

std::optional<int> Heartbeat::lost(double now) const {
    for (std::size_t peer = 0; peer < peers_.size(); ++peer)
        if (peers_[peer].watched && now - peers_[peer].last > peers_[peer].patience)
            return static_cast<int>(peer);
    return {};
}

}  // namespace mpipov
