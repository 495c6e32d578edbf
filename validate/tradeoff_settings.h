// Which settings of a scene are measured against each other, and how each is asked for. Pure.
//
// A sweep is no cross product: one thing is changed at a time, all others stay in the middle of
// their lists. Of each antialiasing method all depths are measured at the middle threshold, all
// thresholds at the middle depth, and the deepest with the lowest threshold, which must be the most
// accurate.
#pragma once

#include "povray_text.h"

#include <string>
#include <string_view>
#include <vector>

namespace mpipov {

// What costs accuracy or time.
enum class Sweep { antialiasing, decomposition, radiosity, threads };
std::string_view to_string(Sweep sweep);
inline const std::vector<Sweep> sweeps{Sweep::antialiasing, Sweep::decomposition, Sweep::radiosity,
                                       Sweep::threads};

struct TradeoffSetting {
    std::string name;  // of a file, too
    std::string what;  // for people
    Sweep sweep = Sweep::antialiasing;
    bool mpipov = false;                 // else POV-Ray alone with one thread
    int ranks = 1;                       // of mpipov
    std::vector<std::string> options;    // mpipov's
    std::vector<std::string> arguments;  // POV-Ray's, behind the user's own
    // The setting whose picture a perfect decomposition would give; empty: this is such a one.
    std::string serial;
};

// What the probe found that decides what is worth sweeping.
struct SceneCalls {
    Antialiasing antialiasing;
    bool radiosity = false, order_dependent = false;
    int longest_side = 1;  // pixels
};

struct TradeoffChoice {
    std::vector<Sweep> sweeps;  // empty: what the scene calls for
    std::vector<int> methods{1, 2}, depths{1, 2, 3, 4, 5}, sections{2, 4, 8, 16, 32, 64},
        halos{1, 2, 4, 8}, threads{1, 2};
    std::vector<double> thresholds{0.3, 0.1, 0.03, 0.01};
    int ranks = 2;  // that render sections
    // Of mpipov's --radiosity, each with the scale of its samples behind a slash where that is
    // not 1.
    std::vector<std::string> radiosity{"independent", "shared:1",   "shared:2",
                                       "shared:3",    "joined:1",   "joined:2",
                                       "shared:1/2",  "shared:1/4", "joined:1/2"};
};

struct LeftOut {
    std::string what, why;
};

struct TradeoffPlan {
    std::vector<TradeoffSetting> settings;
    std::vector<LeftOut> left_out;
    // Of all sweeps but that of the antialiasing: the user's own arguments, or POV-Ray's defaults
    // where those ask for none. Added to the user's arguments.
    std::vector<std::string> base_antialiasing;
};

// Throws Failure(Exit::usage) where a sweep that was asked for by name makes no sense.
TradeoffPlan plan_tradeoff(const TradeoffChoice& choice, const SceneCalls& scene);

// The entry in the middle; of an even number the first of the two.
template <class T>
const T& middle(const std::vector<T>& values) {
    return values[(values.size() - 1) / 2];
}

}  // namespace mpipov
