// Which ranks are still there: each says now and then that it is, and one that says nothing for too
// long counts as lost. TCP alone would not tell for a quarter of an hour that a host was cut off.
// Pure; times are seconds of any clock that only goes forward.
#pragma once

#include <optional>
#include <vector>

namespace mpipov {

class Heartbeat {
  public:
    // Watches nobody yet.
    Heartbeat(int ranks, double lost_after_seconds);

    // From now on, also once more. With `seconds` that peer promises to speak within that time, so
    // that ranks can differ in their patience; by default it is ours.
    void watch(int peer, double now);
    void watch(int peer, double now, double seconds);
    void ignore(int peer);
    void heard(int peer, double now);

    // Whether it is time to say that we are there; the next time comes after that.
    bool due(double now);
    // One that is lost.
    std::optional<int> lost(double now) const;

    double lost_after_seconds() const { return lost_after_; }

  private:
    struct Peer {
        double last = 0, patience = 0;
        bool watched = false;
    };
    std::vector<Peer> peers_;
    double lost_after_;
    std::optional<double> said_;
};

}  // namespace mpipov
