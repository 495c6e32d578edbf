#include "journal.h"
#include "json_parts.h"
#include "tradeoff_report.h"

#include <algorithm>

namespace mpipov {
namespace {

using nlohmann::json;

json spread_json(const std::vector<double>& times) {
    const std::optional<Spread> spread = spread_of(times);
    if (!spread) return nullptr;
    return {{"median", spread->median}, {"low", spread->low}, {"high", spread->high}};
}

json error_json(const std::optional<TradeoffError>& error) {
    if (!error) return nullptr;
    return {{"rms", error->rms},
            {"largest", error->largest},
            {"identical", error->identical},
            {"ssim", number_json(error->ssim.value)},
            {"ssim_reason", text_json(error->ssim.reason)}};
}

json row_json(const TradeoffRow& row, const TradeoffReport& report) {
    const TradeoffSetting& setting = row.setting;
    return {{"name", setting.name},
            {"what", setting.what},
            {"sweep", to_string(setting.sweep)},
            {"mpipov", setting.mpipov},
            {"ranks", setting.ranks},
            {"argv", row.argv},
            {"command", shell_line(row.user_argv)},
            {"wall", row.wall},
            {"cpu", row.cpu},
            {"wall_seconds", spread_json(row.wall)},
            {"cpu_seconds", spread_json(row.cpu)},
            {"sections", row.sections > 0 ? json(row.sections) : json()},
            {"image", file_json(row.image, report.folder)},
            {"pixel_sha1", text_json(row.pixel_sha1)},
            {"varies", row.varies},
            {"against_truth", error_json(row.truth)},
            {"serial", text_json(setting.serial)},
            {"against_serial", error_json(row.serial)},
            {"failure", text_json(row.failure)}};
}

json truth_json(const TradeoffReport& report) {
    if (!report.truth) return nullptr;
    const Truth& truth = *report.truth;
    const std::optional<std::size_t> best = most_accurate(report);
    const auto in_levels = [](double error) { return 255 * error; };
    json share = nullptr;
    if (best && report.rows[*best].truth->rms > 0)
        share = in_levels(truth.error()) / report.rows[*best].truth->rms;
    return {{"samples_per_pixel", truth.samples()},
            {"depth", truth.depth},
            {"argv", truth.argv},
            {"wall_seconds", truth.wall_seconds},
            {"cpu_seconds", truth.cpu_seconds},
            {"error", in_levels(truth.error())},
            {"sampling_error", in_levels(truth.sampling_error)},
            {"rounding_error", in_levels(truth.rounding_error)},
            {"share_of_best", share},
            {"wanted_share", report.truth_share},
            {"stopped", text_json(report.truth_stopped)},
            {"image", file_json(truth.image, report.folder)},
            {"image_sha1", sha1_of_file(truth.image)},
            {"other", file_json(truth.other, report.folder)},
            {"other_sha1", sha1_of_file(truth.other)},
            {"other_averaging_error", number_json(report.other_averaging_error)}};
}

json front_json(const TradeoffReport& report, bool wall) {
    json names = json::array();
    for (const std::size_t at : pareto_front(points_of(report, wall)))
        names.push_back(report.rows[at].setting.name);
    const std::optional<TradeoffLaw> law = law_of(report, wall);
    json found = {{"settings", names}, {"law", nullptr}};
    if (law)
        found["law"] = {{"halving_costs", law->factor}, {"exponent", law->exponent},
                        {"seconds_at_1", law->scale},   {"residual_factor", law->residual},
                        {"from_error", law->from},      {"to_error", law->to},
                        {"points", law->points}};
    return found;
}

json picks_json(const TradeoffReport& report) {
    json picks = json::array();
    for (const TradeoffPick& pick : report.picks)
        picks.push_back(
            {{"limit", pick.limit},
             {"value", pick.value},
             {"setting", pick.row ? json(report.rows[*pick.row].setting.name) : json()},
             {"command", pick.row ? json(shell_line(report.rows[*pick.row].user_argv)) : json()}});
    return picks;
}

}  // namespace

std::vector<std::optional<TradeoffPoint>> points_of(const TradeoffReport& report, bool wall) {
    std::vector<std::optional<TradeoffPoint>> points;
    for (const TradeoffRow& row : report.rows) {
        const std::optional<Spread> seconds = spread_of(wall ? row.wall : row.cpu);
        points.push_back(row.measured() && row.truth && seconds
                             ? std::optional<TradeoffPoint>({seconds->median, row.truth->rms})
                             : std::nullopt);
    }
    return points;
}

std::optional<std::size_t> most_accurate(const TradeoffReport& report) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < report.rows.size(); ++i)
        if (report.rows[i].measured() && report.rows[i].truth &&
            (!best || report.rows[i].truth->rms < report.rows[*best].truth->rms))
            best = i;
    return best;
}

std::optional<TradeoffLaw> law_of(const TradeoffReport& report, bool wall) {
    const std::vector<std::optional<TradeoffPoint>> points = points_of(report, wall);
    std::vector<TradeoffPoint> front;
    for (const std::size_t at : pareto_front(points)) front.push_back(*points[at]);
    return fit_law(without_truths_error(front, report.truth ? 255 * report.truth->error() : 0));
}

json to_json(const TradeoffReport& report) {
    json rows = json::array(), left_out = json::array();
    for (const TradeoffRow& row : report.rows) rows.push_back(row_json(row, report));
    for (const LeftOut& one : report.left_out)
        left_out.push_back({{"what", one.what}, {"why", one.why}});
    return {{"format", "mpipov-tradeoff"},
            {"version", 1},
            {"scene", report.scene},
            {"file", report.file},
            {"arguments", report.arguments},
            {"identity", report.identity},
            {"effects", report.effects},
            {"image", report.image ? typed_image_json(*report.image) : json()},
            {"region", rect_json(report.region)},
            {"versions", report.versions},
            {"host", {{"cores", report.cores}, {"cpu", text_json(report.cpu)}}},
            {"ranks", report.ranks},
            {"repeat", report.repeat},
            {"averaging", report.averaging == Averaging::linear ? "linear" : "encoded"},
            {"complete", report.complete},
            {"failure", text_json(report.failure)},
            {"truth", truth_json(report)},
            {"rows", rows},
            {"left_out", left_out},
            {"front", {{"cpu", front_json(report, false)}, {"wall", front_json(report, true)}}},
            {"sentence", text_json(law_sentence(report))},
            {"picks", picks_json(report)},
            {"notes", report.notes}};
}

}  // namespace mpipov
