#include "json_parts.h"
#include "speedup_report.h"

namespace mpipov {
namespace {

using nlohmann::json;

std::string kind_name(SpeedupVariant::Kind kind) {
    switch (kind) {
        case SpeedupVariant::Kind::serial:
            return "serial";
        case SpeedupVariant::Kind::threads:
            return "threads";
        case SpeedupVariant::Kind::bands:
            return "bands";
        case SpeedupVariant::Kind::mpipov:
            break;
    }
    return "mpipov";
}

json row_json(const SpeedupRow& row, const SpeedupReport& report) {
    const std::vector<double> times = measured(row.times);
    const std::optional<Spread> seconds = spread_of(times);
    const std::optional<Spread> ratio = speed_up(report.rows.front().times, row.times);
    const auto part = [](const std::optional<Spread>& spread, double Spread::*which) {
        return spread ? number_json((*spread).*which) : json();
    };
    json j = {{"name", row.variant.name()},
              {"what", row.variant.what()},
              {"kind", kind_name(row.variant.kind)},
              {"schedule", text_json(row.variant.schedule)},
              {"dedicated", row.variant.dedicated},
              {"ranks", row.variant.ranks},
              {"argv", row.argv},
              {"times", times},
              {"median_seconds", part(seconds, &Spread::median)},
              {"low", part(seconds, &Spread::low)},
              {"high", part(seconds, &Spread::high)},
              {"speedup", part(ratio, &Spread::median)},
              {"speedup_low", part(ratio, &Spread::low)},
              {"speedup_high", part(ratio, &Spread::high)},
              {"efficiency", number_json(efficiency(ratio, row.variant.ranks))},
              {"identical", nullptr},
              {"differing", nullptr},
              {"largest", nullptr},
              {"plan", nullptr},
              {"record", file_json(row.record, report.folder)},
              {"failure", text_json(row.failure)}};
    if (row.difference) {
        j["identical"] = row.difference->differing == 0;
        j["differing"] = row.difference->differing;
        j["largest"] = number_json(row.difference->largest);
    }
    if (row.plan)
        j["plan"] = {{"sections", row.plan->sections},
                     {"threads", row.plan->threads},
                     {"in_flight", row.plan->in_flight}};
    return j;
}

json repetition_json(const SpeedupReport& report, std::size_t index) {
    const SpeedupRepetition& repetition = report.repetitions[index];
    json seconds = json::object();
    for (const SpeedupRow& row : report.rows)
        seconds[row.variant.name()] =
            index < row.times.size() ? number_json(row.times[index]) : json();
    return {
        {"order", repetition.order}, {"load", number_json(repetition.load)}, {"seconds", seconds}};
}

}  // namespace

json to_json(const SpeedupReport& report) {
    json rows = json::array(), repetitions = json::array();
    for (const SpeedupRow& row : report.rows) rows.push_back(row_json(row, report));
    for (std::size_t i = 0; i < report.repetitions.size(); ++i)
        repetitions.push_back(repetition_json(report, i));
    return {{"format", "mpipov-speedup"},
            {"version", 1},
            {"scene", report.scene},
            {"file", report.file},
            {"arguments", report.arguments},
            {"image", report.image ? typed_image_json(*report.image) : json()},
            {"order_dependent", report.order_dependent},
            {"versions", report.versions},
            {"host", {{"cores", report.cores}, {"cpu", text_json(report.cpu)}}},
            {"repeat", report.repeat},
            {"complete", report.complete},
            {"failure", text_json(report.failure)},
            {"rows", rows},
            {"repetitions", repetitions}};
}

}  // namespace mpipov
