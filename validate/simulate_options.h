// The command line of `mpipov-validate simulate`, and the case that it asks for.
#pragma once

#include "simulate_report.h"

#include <CLI/App.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mpipov {

struct SimulateOptions {
    std::string run, costs, size, map = "uniform";
    std::optional<double> serial_seconds, against;

    std::string ranks, schedule = "dynamic", shape = "auto", seams, speeds = "1";
    std::optional<int> sections, in_flight, threads;
    int slots = 1, ranks_per_host = 0;
    bool dedicated = false;

    std::map<std::string, double> values;  // by name of the term
    std::optional<double> coordinator_rate;
    std::vector<std::string> without;
    std::vector<std::string> bars;  // N:E
    std::string json;

    bool paper = false;
    std::optional<double> paper_latency;
    std::optional<int> strips;
};

void add_simulate_options(CLI::App& app, SimulateOptions& options);

// All throw Failure: Exit::usage for what cannot be, Exit::file for what cannot be read.
SimulateCase simulate_case(const SimulateOptions& options);
std::vector<int> simulate_ranks(const SimulateOptions& options);
std::vector<SimulateBar> simulate_bars(const SimulateOptions& options);

}  // namespace mpipov
