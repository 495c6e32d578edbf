// What `mpipov-validate simulate` simulates: where tracing costs what, the ranks, and the terms of
// the model, each with its value and its source, or why it is off. Pure.
#pragma once

#include "cost_map.h"
#include "run_record.h"
#include "schedule.h"
#include "virtual_run.h"

#include <optional>
#include <string>
#include <vector>

namespace mpipov {

// Names of terms. Each can be switched off, which shows what it costs.
namespace term {
inline constexpr const char *start = "start-up", *end = "end", *bare = "bare launch",
                            *parse = "parse", *photons = "photons", *radiosity = "pretrace",
                            *frame = "frame", *answer = "answer", *service = "coordinator",
                            *rank0 = "rank 0", *latency = "latency", *bandwidth = "bandwidth",
                            *before = "before", *after = "after", *gathering = "gathering",
                            *copies = "copies", *uneven = "uneven sections";
}  // namespace term

struct SimulateTerm {
    std::string name;
    double value = 0;
    std::string unit;
    bool on = false;
    std::string why;  // where the value comes from, or why it is off
};

struct SimulateCase {
    CostMap costs = uniform_costs({0, 0, 1, 1}, 0);
    std::string costs_from;
    int width = 1, height = 1;  // of the whole image
    GridRequest grid;           // region, seams, halo, block; shape where it is given
    bool auto_shape = true;     // columns while they suffice, else tiles
    Policy policy = Policy::dynamic;
    std::optional<int> sections;   // empty: the number that ends first
    std::optional<int> in_flight;  // by rank; empty: the number that ends first
    int threads = 1, slots = 1;
    std::vector<double> speeds = {1};  // of the ranks in turn
    int ranks_per_host = 0;            // 0: all on one host
    bool dedicated = false;
    double bytes_per_pixel = 3;
    // CPU seconds of tracing of the sections of each wave that gathers radiosity samples.
    std::vector<std::vector<double>> waves;
    std::optional<double> against;  // what the speed-up is against; empty: what the terms say
    std::vector<SimulateTerm> terms;

    // 0 where it is off.
    double value(const std::string& name) const;
    bool on(const std::string& name) const;
    SimulateCase without(const std::string& name) const;

    double launch_cpu() const;  // of every launch, besides tracing
    // POV-Ray alone, one thread, on a core of speed 1. With waves and without `against` it traces
    // all that they trace, which is more than it would.
    double serial_seconds() const;
};

// The terms of any run: measured values that need no scene. Sources: docs/simulation.md.
std::vector<SimulateTerm> default_terms(int width, int height);
// Gives a term a value and a source, and switches it on.
void set_term(std::vector<SimulateTerm>& terms, const std::string& name, double value,
              const std::string& why);
void switch_off(std::vector<SimulateTerm>& terms, const std::string& name, const std::string& why);

// Costs, grid and terms as a finished run's record tells them. Throws std::invalid_argument where
// the record is of a run that went on from another, or was not finished.
SimulateCase case_of_run(const RunRecord& record);

// So many sections of the image. Throws std::invalid_argument where no grid has so many.
std::vector<Section> cut(const SimulateCase& what, int sections);
long long most_sections(const SimulateCase& what);

// How long `ranks` ranks take for the waves.
double gathering_seconds(const SimulateCase& what, int ranks, int in_flight);

// The run of `ranks` ranks with such sections and launches in flight.
VirtualRun virtual_run(const SimulateCase& what, int ranks, const std::vector<Section>& sections,
                       int in_flight);

}  // namespace mpipov
