#include "simulate_sweep.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace mpipov {
namespace {

// In lanes. More than 64 are never worth their launches.
constexpr int section_steps[] = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64};
constexpr int in_flight_steps[] = {1, 2, 3, 4};
// A climb goes on past so many numbers that are no better: rounding to whole rounds makes dents.
constexpr int patience = 2;

struct Try {
    VirtualOutcome outcome;
    std::size_t grid = 0, flight = 0;  // indices of what was tried
};

// The best grid for one case on so many ranks.
class Search {
  public:
    Search(const SimulateCase& what, int ranks) : what_(what), ranks_(ranks) {
        const int first = what.dedicated ? 1 : 0;
        if (ranks <= first)
            throw std::invalid_argument(
                "no rank is left to render: --dedicated-coordinator needs 2 ranks");
        const int lanes_of_rank = std::max(1, what.slots / what.threads);
        const long long lanes = 1LL * lanes_of_rank * (ranks - first);
        const long long most = most_sections(what);
        if (what.sections) {
            grids_ = {*what.sections};
        } else if (what.policy == Policy::static_) {
            grids_ = {static_cast<int>(std::min(lanes, most))};
        } else {
            for (const int step : section_steps)
                if (lanes * step < most) grids_.push_back(static_cast<int>(lanes * step));
            if (grids_.size() < std::size(section_steps)) grids_.push_back(static_cast<int>(most));
        }
        const bool one_round = grids_.size() == 1 && grids_[0] <= lanes;
        if (what.in_flight) {
            flights_ = {*what.in_flight};
        } else if (one_round) {
            flights_ = {lanes_of_rank};
        } else {
            for (const int step : in_flight_steps) flights_.push_back(lanes_of_rank * step);
        }
        for (const int count : grids_) sections_.push_back(cut(what, count));
    }

    Try best() {
        Try found;
        double least = never;
        for (std::size_t flight = 0; flight < flights_.size(); ++flight) {
            int worse = 0;
            double here = never;
            for (std::size_t grid = 0; grid < grids_.size() && worse <= patience; ++grid) {
                const double seconds = wall(what_, grid, flight);
                worse = seconds < here ? 0 : worse + 1;
                here = std::min(here, seconds);
                if (seconds >= least) continue;
                least = seconds;
                found = {{}, grid, flight};
            }
        }
        found.outcome = run(what_, found.grid, found.flight);
        return found;
    }

    // Wall seconds of another case on the same ranks and grids, from the best of this one to where
    // its neighbours are no better.
    double best_near(const SimulateCase& other, const Try& from) const {
        std::size_t grid = from.grid, flight = from.flight;
        double least = wall(other, grid, flight);
        for (bool better = true; better;) {
            better = false;
            for (const auto& [down, right] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
                const std::size_t g = grid + static_cast<std::size_t>(down),
                                  f = flight + static_cast<std::size_t>(right);
                if (g >= grids_.size() || f >= flights_.size()) continue;
                const double seconds = wall(other, g, f);
                if (seconds >= least * (1 - 1e-9)) continue;
                least = seconds;
                grid = g;
                flight = f;
                better = true;
                break;
            }
        }
        return least;
    }

    int sections(const Try& one) const { return grids_[one.grid]; }
    int in_flight(const Try& one) const { return flights_[one.flight]; }

  private:
    VirtualOutcome run(const SimulateCase& what, std::size_t grid, std::size_t flight) const {
        return run_virtually(virtual_run(what, ranks_, sections_[grid], flights_[flight]));
    }
    double wall(const SimulateCase& what, std::size_t grid, std::size_t flight) const {
        return run(what, grid, flight).wall_seconds;
    }

    const SimulateCase& what_;
    int ranks_;
    std::vector<int> grids_, flights_;
    std::vector<std::vector<Section>> sections_;  // by grid
};

double power_of(const SimulateCase& what, int ranks) {
    double power = 0;
    for (int i = 0; i < ranks; ++i)
        power += what.slots * what.speeds[static_cast<std::size_t>(i) % what.speeds.size()];
    return power;
}

}  // namespace

double shortest(const SimulateCase& what, int ranks) {
    return Search(what, ranks).best().outcome.wall_seconds;
}

SimulateRow simulate(const SimulateCase& what, int ranks) {
    Search search(what, ranks);
    const Try best = search.best();
    const double serial = what.serial_seconds();

    SimulateRow row;
    row.ranks = ranks;
    row.cores = ranks * what.slots;
    row.power = power_of(what, ranks);
    row.sections = search.sections(best);
    row.in_flight = search.in_flight(best);
    row.launches = best.outcome.launches;
    row.copies = best.outcome.copies;
    row.wall_seconds = best.outcome.wall_seconds;
    const auto efficiency = [&](double wall) { return wall > 0 ? serial / wall / row.power : 0; };
    row.speedup = row.wall_seconds > 0 ? serial / row.wall_seconds : 0;
    row.efficiency = efficiency(row.wall_seconds);
    const double rendering = row.wall_seconds - what.value(term::before) -
                             gathering_seconds(what, ranks, row.in_flight) -
                             what.value(term::after);
    row.handled_by_second = rendering > 0 ? row.launches / rendering : 0;

    for (const SimulateTerm& one : what.terms) {
        if (!one.on || one.name == term::copies) continue;
        const double wall = search.best_near(what.without(one.name), best);
        row.without.push_back({one.name, wall, efficiency(wall)});
    }
    std::stable_sort(
        row.without.begin(), row.without.end(),
        [](const WithoutTerm& a, const WithoutTerm& b) { return a.wall_seconds < b.wall_seconds; });
    SimulateCase rest = what;
    for (const WithoutTerm& one : row.without) {
        rest = rest.without(one.term);
        const double wall = search.best_near(rest, best);
        row.one_by_one.push_back({one.term, wall, efficiency(wall)});
    }
    const bool any =
        !row.without.empty() && row.without.front().wall_seconds < 0.99 * row.wall_seconds;
    row.bound_by = any ? row.without.front().term : "cores";
    return row;
}

}  // namespace mpipov
