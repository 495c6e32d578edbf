// What `mpipov-validate simulate` found, as JSON and as text.
#pragma once

#include "paper_machine.h"
#include "simulate_sweep.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace mpipov {

// An efficiency that was asked for on so many ranks.
struct SimulateBar {
    int ranks = 1;
    double efficiency = 0;
};

struct SimulateReport {
    SimulateCase what;
    std::vector<SimulateRow> rows;
    std::vector<SimulateBar> bars;

    const SimulateRow* row(int ranks) const;
    bool met(const SimulateBar& bar) const;
};

nlohmann::json to_json(const SimulateReport& report);
std::string to_table(const SimulateReport& report);

// The machine of 1999 with its two programs, and with mpipov's protocol.
struct PaperRow {
    int ranks = 1;
    double mpipov1 = 0;             // speed-ups against serial
    std::optional<double> mpipov2;  // needs two ranks
    double ours = 0;                // our protocol, sections rendered without launching anything
    double ours_launched = 0;       // with the launches of today's POV-Ray
};

struct PaperReport {
    CostMap costs = uniform_costs({0, 0, 1, 1}, 0);
    std::string costs_from;
    PaperMachine machine;
    std::optional<int> strips;  // empty: n + 1, n being the ranks that render
    bool latency_fitted = false;
    std::vector<SimulateTerm> terms;  // of our protocol with launches
    std::vector<PaperRow> rows;
    std::vector<std::pair<PaperCell, double>> cells;  // what is known, and what the model says
    // The shortest serial render with which our protocol, launches included, is as fast on 8 ranks
    // as was wanted; none within a day.
    std::optional<double> serial_wanted;
};

constexpr double wanted_on_eight = 7.6;

// From the cost map, the machine and the strips; fits the latency where `fit`.
PaperReport simulate_paper(const CostMap& costs, PaperMachine machine, std::optional<int> strips,
                           bool fit, const std::vector<int>& ranks);

nlohmann::json to_json(const PaperReport& report);
std::string to_table(const PaperReport& report);

}  // namespace mpipov
