#include "simulate_report.h"

#include <algorithm>
#include <stdexcept>

namespace mpipov {
namespace {

int strips_on(const std::optional<int>& strips, int ranks) {
    return strips.value_or(fewest_strips(ranks));
}

// mpipov on the paper's machine: each rank is a host of one core, as there.
SimulateCase our_case(const CostMap& costs, const PaperMachine& machine) {
    SimulateCase ours;
    ours.costs = costs;
    ours.width = costs.region().width();
    ours.height = costs.region().height();
    ours.grid = {costs.region(), Shape::tiles, Seams::aligned, 1, 0, 32};
    ours.ranks_per_host = 1;
    ours.bytes_per_pixel = machine.bytes_per_pixel;
    ours.terms = default_terms(ours.width, ours.height);
    // A file at the end and a probe at the start are no part of what the paper compares.
    switch_off(ours.terms, term::before, "the paper's times are of rendering");
    switch_off(ours.terms, term::after, "the paper's times are of rendering");
    set_term(ours.terms, term::latency, machine.latency, "as for MPIPOV1 and 2");
    set_term(ours.terms, term::bandwidth, machine.bytes_per_second, "as for MPIPOV1 and 2");
    return ours;
}

SimulateCase without_launches(SimulateCase ours) {
    for (const char* name : {term::start, term::bare, term::frame})
        switch_off(ours.terms, name, "the paper's ranks are one program from start to end");
    return ours;
}

double speedup_of(const SimulateCase& what, int ranks) {
    // Against the same serial render as MPIPOV1 and 2, which starts no other program.
    return what.costs.cpu_seconds() / shortest(what, ranks);
}

double speedup_of_known(const PaperReport& report, const PaperCell& cell) {
    const double seconds = cell.version == 1
                               ? mpipov1_seconds(report.costs, report.machine, cell.ranks)
                               : mpipov2_seconds(report.costs, report.machine, cell.ranks,
                                                 strips_on(report.strips, cell.ranks));
    return report.costs.cpu_seconds() / seconds;
}

// On eight ranks with launches, if serial took so long and a line's share of latency stayed.
std::optional<double> serial_wanted(const CostMap& costs, const PaperMachine& machine) {
    const double now = costs.cpu_seconds();
    const auto enough = [&](double seconds) {
        std::vector<CostPatch> patches = costs.patches();
        for (CostPatch& patch : patches) patch.cpu_seconds *= seconds / now;
        PaperMachine scaled = machine;
        scaled.latency *= seconds / now;
        return speedup_of(our_case({costs.region(), std::move(patches)}, scaled), 8) >=
               wanted_on_eight;
    };
    double low = 1, high = 86400;
    if (!enough(high)) return {};
    if (enough(low)) return low;
    while (high / low > 1.02) {
        const double middle = (low + high) / 2;
        (enough(middle) ? high : low) = middle;
    }
    return high;
}

}  // namespace

PaperReport simulate_paper(const CostMap& costs, PaperMachine machine, std::optional<int> strips,
                           bool fit, const std::vector<int>& ranks) {
    PaperReport report;
    report.costs = costs;
    report.strips = strips;
    const std::vector<PaperCell> known = known_paper_cells();
    if (fit) {
        const auto cell = std::find_if(known.begin(), known.end(),
                                       [](const PaperCell& one) { return one.fitted; });
        const std::optional<double> latency =
            fit_latency(costs, machine, cell->ranks, strips_on(strips, cell->ranks), cell->speedup);
        if (!latency)
            throw std::invalid_argument(
                "with this bandwidth no latency gives MPIPOV2's speed-up "
                "of 0.89 on 2 ranks: give --paper-latency");
        machine.latency = *latency;
    }
    report.machine = machine;
    report.latency_fitted = fit;
    const SimulateCase ours = our_case(costs, machine);
    const SimulateCase unlaunched = without_launches(ours);
    report.terms = ours.terms;
    const double serial = costs.cpu_seconds();
    for (const int n : ranks) {
        PaperRow row;
        row.ranks = n;
        row.mpipov1 = serial / mpipov1_seconds(costs, machine, n);
        if (n > 1) row.mpipov2 = serial / mpipov2_seconds(costs, machine, n, strips_on(strips, n));
        row.ours = speedup_of(unlaunched, n);
        row.ours_launched = speedup_of(ours, n);
        report.rows.push_back(row);
    }
    for (const PaperCell& cell : known)
        report.cells.emplace_back(cell, speedup_of_known(report, cell));
    report.serial_wanted = serial_wanted(costs, machine);
    return report;
}

}  // namespace mpipov
