#include "speedup_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <set>

namespace mpipov {
namespace {

using Out = std::back_insert_iterator<std::string>;
using Cell = std::function<std::string(const SpeedupRow&)>;

constexpr std::string_view nothing = "-";

// Two decimals, and no fewer than three digits: 0.0123, 1.23, 123.
std::string number(double value) {
    return value < 0.1 ? fmt::format("{:.3g}", value) : fmt::format("{:.2f}", value);
}

std::string with_spread(const std::optional<Spread>& spread) {
    if (!spread) return std::string(nothing);
    return fmt::format("{} ({}..{})", number(spread->median), number(spread->low),
                       number(spread->high));
}

std::vector<std::string> lines_of(const SpeedupReport& report) {
    std::vector<std::string> lines;
    for (const SpeedupRow& row : report.rows)
        if (std::find(lines.begin(), lines.end(), row.variant.what()) == lines.end())
            lines.push_back(row.variant.what());
    return lines;
}

void table(Out out, const SpeedupReport& report, const std::string& heading, const Cell& cell) {
    const std::vector<std::string> lines = lines_of(report);
    std::size_t first = heading.size();
    for (const std::string& line : lines) first = std::max(first, line.size());
    std::set<int> columns;
    std::size_t width = 6;
    for (const SpeedupRow& row : report.rows) {
        columns.insert(row.variant.ranks);
        width = std::max(width, cell(row).size());
    }
    fmt::format_to(out, "\n{:<{}}", heading, first);
    for (const int n : columns) fmt::format_to(out, "  {:>{}}", n, width);
    fmt::format_to(out, "\n");
    for (const std::string& line : lines) {
        std::string said = fmt::format("{:<{}}", line, first);
        for (const int n : columns) {
            const auto row =
                std::find_if(report.rows.begin(), report.rows.end(), [&](const SpeedupRow& r) {
                    return r.variant.ranks == n && r.variant.what() == line;
                });
            said += fmt::format("  {:>{}}", row == report.rows.end() ? "" : cell(*row), width);
        }
        said.erase(said.find_last_not_of(' ') + 1);
        fmt::format_to(out, "{}\n", said);
    }
}

void images(Out out, const SpeedupReport& report) {
    bool any = false;
    for (const SpeedupRow& row : report.rows) {
        if (!row.difference || row.difference->differing == 0) continue;
        if (!any) fmt::format_to(out, "\nImages that are not the serial one\n");
        any = true;
        fmt::format_to(out, "  {:<28} {} pixels differ", row.variant.name(),
                       row.difference->differing);
        if (row.difference->largest)
            fmt::format_to(out, ", by up to {:.4g} {}", *row.difference->largest,
                           report.image && report.image->integer() ? "levels" : "");
        fmt::format_to(out, "\n");
    }
    if (any && report.order_dependent)
        fmt::format_to(out,
                       "  The scene depends on the order of rendering: mpipov-validate seams says "
                       "whether that is noise.\n");
    if (!any) fmt::format_to(out, "\nAll images that were made are the serial one bit for bit.\n");
}

}  // namespace

std::string to_table(const SpeedupReport& report) {
    std::string text;
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "{}", report.scene.empty() ? "no scene" : report.scene);
    if (report.image)
        fmt::format_to(out, ", {} x {} pixels, {}, {}", report.image->width, report.image->height,
                       fmt::join(report.image->channels, ","), report.image->depth);
    fmt::format_to(out, "; {} cores{}; {} of {} repetitions{}\n", report.cores,
                   report.cpu.empty() ? "" : ", " + report.cpu, report.repetitions.size(),
                   report.repeat, report.complete ? "" : ", NOT COMPLETE");
    if (!report.failure.empty()) fmt::format_to(out, "stopped: {}\n", report.failure);
    if (report.rows.empty()) return text;

    const Times& serial = report.rows.front().times;
    table(out, report, "Wall seconds, by processors", [](const SpeedupRow& row) {
        const std::optional<Spread> seconds = spread_of(measured(row.times));
        return !seconds && !row.failure.empty() ? "failed" : with_spread(seconds);
    });
    table(out, report, "Speed-up against serial",
          [&](const SpeedupRow& row) { return with_spread(speed_up(serial, row.times)); });
    table(out, report, "Efficiency", [&](const SpeedupRow& row) {
        const std::optional<double> found =
            efficiency(speed_up(serial, row.times), row.variant.ranks);
        return found ? number(*found) : std::string(nothing);
    });
    images(out, report);
    for (const SpeedupRow& row : report.rows)
        if (!row.failure.empty())
            fmt::format_to(out, "FAILED {}: {}\n", row.variant.name(), row.failure);
    fmt::format_to(out,
                   "\nMedian (smallest..largest) over the repetitions. Speed-up: serial median "
                   "through this median; its spread is that of the ratios within one "
                   "repetition.\n");
    return text;
}

}  // namespace mpipov
