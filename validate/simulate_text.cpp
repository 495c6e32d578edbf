#include "simulate_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

namespace mpipov {
namespace {

using Out = std::back_insert_iterator<std::string>;

// A term that is worth less for the efficiency is not told.
constexpr double least_gain = 0.005;

void terms(Out out, const std::vector<SimulateTerm>& all) {
    fmt::format_to(out, "\nTerms on\n");
    for (const SimulateTerm& one : all)
        if (one.on)
            fmt::format_to(out, "  {:<15} {:>10} {} ({})\n", one.name,
                           one.value > 0 ? fmt::format("{:.4g}", one.value) : "", one.unit,
                           one.why);
    fmt::format_to(out, "Terms off\n");
    for (const SimulateTerm& one : all)
        if (!one.on) fmt::format_to(out, "  {:<15} {}\n", one.name, one.why);
}

std::string gains(const SimulateRow& row) {
    std::string text;
    for (const WithoutTerm& one : row.without)
        if (one.efficiency >= row.efficiency + least_gain)
            text += fmt::format("{}without {}: {:.3f}", text.empty() ? "" : ", ", one.term,
                                one.efficiency);
    return text;
}

void say_bar(Out out, const SimulateReport& report, const SimulateBar& bar) {
    const SimulateRow* row = report.row(bar.ranks);
    if (row == nullptr) return;
    fmt::format_to(out, "bar {:.3f} at {} ranks: {}, {:.3f}", bar.efficiency, bar.ranks,
                   report.met(bar) ? "met" : "MISSED", row->efficiency);
    std::vector<std::string> taken;
    if (!report.met(bar)) {
        double reached = row->efficiency;
        for (const WithoutTerm& one : row->one_by_one) {
            if (reached >= bar.efficiency) break;
            taken.push_back(one.term);
            reached = one.efficiency;
        }
        fmt::format_to(out, "; {} without {}: {:.3f}",
                       reached >= bar.efficiency ? "met" : "missed even", fmt::join(taken, " + "),
                       reached);
    }
    fmt::format_to(out, "\n");
}

}  // namespace

const SimulateRow* SimulateReport::row(int ranks) const {
    const auto found = std::find_if(rows.begin(), rows.end(),
                                    [&](const SimulateRow& one) { return one.ranks == ranks; });
    return found == rows.end() ? nullptr : &*found;
}

bool SimulateReport::met(const SimulateBar& bar) const {
    const SimulateRow* found = row(bar.ranks);
    return found != nullptr && found->efficiency >= bar.efficiency;
}

std::string to_table(const SimulateReport& report) {
    const SimulateCase& what = report.what;
    std::string text;
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "SIMULATED: {} x {} pixels; {:.4g} CPU s of tracing, {}; serial {:.4g} s\n",
                   what.width, what.height, what.costs.cpu_seconds(), what.costs_from,
                   what.serial_seconds());
    fmt::format_to(out, "schedule {}; each rank {} core{}, speed {}; {} thread{} a launch{}{}\n",
                   to_string(what.policy), what.slots, what.slots == 1 ? "" : "s",
                   fmt::join(what.speeds, ", "), what.threads, what.threads == 1 ? "" : "s",
                   what.dedicated ? "; rank 0 renders nothing" : "",
                   what.ranks_per_host > 0 ? fmt::format("; {} a host", what.ranks_per_host) : "");
    fmt::format_to(out, "\n{:>6} {:>7} {:>9} {:>9} {:>10} {:>9} {:>10} {:>8}  {}\n", "ranks",
                   "cores", "sections", "in flight", "wall s", "speed-up", "efficiency", "asked/s",
                   "bound by");
    for (const SimulateRow& row : report.rows)
        fmt::format_to(out, "{:>6} {:>7} {:>9} {:>9} {:>10.4g} {:>9.4g} {:>10.3f} {:>8.3g}  {}\n",
                       row.ranks, row.cores, row.sections, row.in_flight, row.wall_seconds,
                       row.speedup, row.efficiency, row.handled_by_second, row.bound_by);
    fmt::format_to(out, "\nEfficiency, were a term not there\n");
    for (const SimulateRow& row : report.rows) {
        const std::string found = gains(row);
        fmt::format_to(out, "{:>6}  {}\n", row.ranks,
                       found.empty() ? "no term is worth 0.005" : found);
    }
    fmt::format_to(out, "\nThe first in the way\n");
    for (const SimulateRow& row : report.rows)
        fmt::format_to(out, "{:>6}  {}: {}\n", row.ranks, row.bound_by, law_of(what, row));
    terms(out, what.terms);
    if (!report.bars.empty()) fmt::format_to(out, "\n");
    for (const SimulateBar& bar : report.bars) say_bar(out, report, bar);
    return text;
}

std::string to_table(const PaperReport& report) {
    std::string text;
    const auto out = std::back_inserter(text);
    const PaperMachine& machine = report.machine;
    const double line = report.costs.cpu_seconds() / report.costs.region().height();
    fmt::format_to(out,
                   "SIMULATED: the paper's machine, {} x {} pixels, serial {:.4g} s, {}\n"
                   "latency {:.4g} ms, {:.3g} of a line ({}); {:.4g} bytes/s; MPIPOV2 with {} "
                   "strips\n",
                   report.costs.region().width(), report.costs.region().height(),
                   report.costs.cpu_seconds(), report.costs_from, 1e3 * machine.latency,
                   machine.latency / line, report.latency_fitted ? "fitted" : "given",
                   machine.bytes_per_second,
                   report.strips ? fmt::format("{}", *report.strips) : "n + 1");
    fmt::format_to(out, "\n{:<48}", "Speed-up, by processors");
    for (const PaperRow& row : report.rows) fmt::format_to(out, " {:>6}", row.ranks);
    const auto line_of = [&](const char* name, const auto& cell) {
        fmt::format_to(out, "\n{:<48}", name);
        for (const PaperRow& row : report.rows) {
            const std::optional<double> value = cell(row);
            fmt::format_to(out, " {:>6}", value ? fmt::format("{:.2f}", *value) : "-");
        }
    };
    line_of("MPIPOV1 (1999)", [](const PaperRow& row) { return std::optional(row.mpipov1); });
    line_of("MPIPOV2 (1999)", [](const PaperRow& row) { return row.mpipov2; });
    line_of("mpipov's protocol, one program as in 1999",
            [](const PaperRow& row) { return std::optional(row.ours); });
    line_of("mpipov's protocol, launches of POV-Ray 3.7",
            [](const PaperRow& row) { return std::optional(row.ours_launched); });
    fmt::format_to(out, "\n\nWhat is known of the paper's Tables 1 and 2\n");
    for (const auto& [cell, model] : report.cells)
        fmt::format_to(out, "  MPIPOV{} on {}: {}{:.2f}, the model {:.2f} ({:+.1f} %), {}\n",
                       cell.version, cell.ranks,
                       cell.version == 2 && cell.ranks == 8 ? "about " : "", cell.speedup, model,
                       100 * (model / cell.speedup - 1),
                       cell.fitted && report.latency_fitted ? "fitted" : "predicted");
    fmt::format_to(out, "\nWith launches of POV-Ray 3.7, mpipov reaches {:.1f} on 8 ranks ",
                   wanted_on_eight);
    fmt::format_to(out, "{}\n",
                   report.serial_wanted
                       ? fmt::format("where serial takes {:.3g} s or more.", *report.serial_wanted)
                       : "with no render of a day or less.");
    terms(out, report.terms);
    return text;
}

}  // namespace mpipov
