#include "tradeoff_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace mpipov {
namespace {

using Out = std::back_insert_iterator<std::string>;
using Cells = std::array<std::string, 7>;

constexpr std::string_view nothing = "-";

std::string seconds(const std::vector<double>& times) {
    const std::optional<Spread> spread = spread_of(times);
    if (!spread) return std::string(nothing);
    if (times.size() == 1) return fmt::format("{:.2f}", spread->median);
    return fmt::format("{:.2f} ({:.2f}..{:.2f})", spread->median, spread->low, spread->high);
}

std::string error(const std::optional<TradeoffError>& found) {
    if (!found) return std::string(nothing);
    return found->identical ? "identical" : fmt::format("{:.3g}", found->rms);
}

std::string ssim(const std::optional<TradeoffError>& found) {
    if (!found || found->identical || !found->ssim.value) return std::string(nothing);
    return fmt::format("{:.5f}", *found->ssim.value);
}

Cells cells_of(const TradeoffRow& row, bool in_front) {
    std::string what = row.setting.what;
    if (row.varies) what += ", another picture each time";
    return {what,
            seconds(row.cpu),
            seconds(row.wall),
            error(row.truth),
            ssim(row.truth),
            error(row.serial),
            in_front ? "*" : ""};
}

void table(Out out, const TradeoffReport& report) {
    const std::vector<std::size_t> front = pareto_front(points_of(report, false));
    std::vector<Cells> lines{
        {"", "CPU seconds", "wall seconds", "error", "SSIM", "against serial", "front"}};
    std::vector<std::string_view> sweep_of{""};
    for (std::size_t i = 0; i < report.rows.size(); ++i) {
        const TradeoffRow& row = report.rows[i];
        if (!row.measured()) continue;
        lines.push_back(cells_of(row, std::find(front.begin(), front.end(), i) != front.end()));
        sweep_of.push_back(to_string(row.setting.sweep));
    }
    Cells::value_type::size_type widths[std::tuple_size_v<Cells>] = {};
    for (const Cells& line : lines)
        for (std::size_t c = 0; c < line.size(); ++c)
            widths[c] = std::max(widths[c], line[c].size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (i > 0 && sweep_of[i] != sweep_of[i - 1]) fmt::format_to(out, "{}\n", sweep_of[i]);
        std::string said = fmt::format("  {:<{}}", lines[i][0], widths[0]);
        for (std::size_t c = 1; c < lines[i].size(); ++c)
            said += fmt::format("  {:>{}}", lines[i][c], widths[c]);
        said.erase(said.find_last_not_of(' ') + 1);
        fmt::format_to(out, "{}\n", said);
    }
}

void truth(Out out, const TradeoffReport& report) {
    if (!report.truth) return;
    const Truth& found = *report.truth;
    fmt::format_to(out, "Truth: {} samples a pixel, averaged in {}; its own error is {:.3g}",
                   found.samples(),
                   report.averaging == Averaging::linear ? "linear light" : "encoded values",
                   255 * found.error());
    if (const std::optional<std::size_t> best = most_accurate(report);
        best && report.rows[*best].truth->rms > 0)
        fmt::format_to(out, ", {:.0f} % of the best setting's",
                       100 * 255 * found.error() / report.rows[*best].truth->rms);
    fmt::format_to(out, "{}\n",
                   report.truth_stopped.empty() ? "" : " (" + report.truth_stopped + ")");
}

void picks(Out out, const TradeoffReport& report) {
    for (const TradeoffPick& pick : report.picks) {
        if (!pick.row) {
            fmt::format_to(out, "\n{} {:g}: no setting does that\n", pick.limit, pick.value);
            continue;
        }
        const TradeoffRow& row = report.rows[*pick.row];
        fmt::format_to(out, "\n{} {:g}: {}: error {:.3g}, {:.2f} s\n  {}\n", pick.limit, pick.value,
                       row.setting.what, row.truth->rms, spread_of(row.wall)->median,
                       shell_line(row.user_argv));
    }
}

}  // namespace

std::string law_sentence(const TradeoffReport& report) {
    const std::optional<TradeoffLaw> law = law_of(report, false);
    if (!law) return {};
    return fmt::format(
        "Halving the error costs {:.2f} times the CPU time: fitted over {} settings "
        "of the front, errors {:.3g} to {:.3g}, which lie within a factor of {:.2f} "
        "of it.",
        law->factor, law->points, law->from, law->to, law->residual);
}

std::string shell_line(const std::vector<std::string>& argv) {
    std::string line;
    for (const std::string& word : argv) {
        if (!line.empty()) line += ' ';
        const bool plain = !word.empty() && word.find_first_not_of(
                                                "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVW"
                                                "XYZ0123456789_-+=:,./@%") == std::string::npos;
        if (plain) {
            line += word;
            continue;
        }
        line += '\'';
        for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
        line += '\'';
    }
    return line;
}

std::string to_table(const TradeoffReport& report) {
    std::string text;
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "{}", report.scene.empty() ? "no scene" : report.scene);
    if (report.image)
        fmt::format_to(out, ", {} x {} pixels", report.image->width, report.image->height);
    fmt::format_to(out, "; {} cores{}; {} repetition{}{}\n", report.cores,
                   report.cpu.empty() ? "" : ", " + report.cpu, report.repeat,
                   report.repeat == 1 ? "" : "s", report.complete ? "" : ", NOT COMPLETE");
    if (!report.failure.empty()) fmt::format_to(out, "stopped: {}\n", report.failure);
    truth(out, report);
    fmt::format_to(out, "\n");
    table(out, report);
    fmt::format_to(out, "\n");
    for (const TradeoffRow& row : report.rows)
        if (!row.failure.empty())
            fmt::format_to(out, "FAILED {}: {}\n", row.setting.name, row.failure);
    for (const LeftOut& one : report.left_out)
        fmt::format_to(out, "Left out: {}: {}\n", one.what, one.why);
    for (const std::string& note : report.notes) fmt::format_to(out, "Note: {}\n", note);
    fmt::format_to(
        out,
        "Errors: RMS of sRGB-encoded values, levels of 255, against the truth and against "
        "the serial render\nof the same antialiasing. Seconds: median "
        "(smallest..largest). *: no other is as fast and as accurate, by CPU seconds.\n");
    if (const std::string law = law_sentence(report); !law.empty())
        fmt::format_to(out, "\n{}\n", law);
    picks(out, report);
    return text;
}

}  // namespace mpipov
