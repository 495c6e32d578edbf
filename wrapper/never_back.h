// A clock that jumps, made into one that does not go back.
#pragma once

#include <algorithm>
#include <functional>
#include <utility>

namespace mpipov {

// Where `clock` (seconds) goes back, the new one stands still that once, and then goes on at the
// same pace. All clocks that the programs give are steady; a coordinator that waited for one to
// come back would leave a stuck launch alone for as long. A jump ahead cannot be told from a sleep:
// it lets idle ranks copy sections, which costs time and no pixel.
inline std::function<double()> never_back(std::function<double()> clock) {
    return [clock = std::move(clock), last = 0.0, lost = 0.0, begun = false]() mutable {
        const double now = clock();
        if (begun) lost += std::max(0.0, last - now);
        begun = true;
        last = now;
        return now + lost;
    };
}

}  // namespace mpipov
