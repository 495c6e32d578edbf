#include "json_parts.h"
#include "simulate_report.h"

namespace mpipov {
namespace {

using nlohmann::json;

json terms_json(const std::vector<SimulateTerm>& terms) {
    json all = json::array();
    for (const SimulateTerm& one : terms)
        all.push_back({{"name", one.name},
                       {"on", one.on},
                       {"value", one.value},
                       {"unit", one.unit},
                       {"why", one.why}});
    return all;
}

json without_json(const std::vector<WithoutTerm>& terms) {
    json all = json::array();
    for (const WithoutTerm& one : terms)
        all.push_back({{"term", one.term},
                       {"wall_seconds", one.wall_seconds},
                       {"efficiency", one.efficiency}});
    return all;
}

json row_json(const SimulateReport& report, const SimulateRow& row) {
    return {{"ranks", row.ranks},
            {"cores", row.cores},
            {"power", row.power},
            {"sections", row.sections},
            {"in_flight", row.in_flight},
            {"launches", row.launches},
            {"copies", row.copies},
            {"wall_seconds", row.wall_seconds},
            {"speedup", row.speedup},
            {"efficiency", row.efficiency},
            {"sections_by_second", row.handled_by_second},
            {"bound_by", row.bound_by},
            {"law", law_of(report.what, row)},
            {"without", without_json(row.without)},
            {"one_by_one", without_json(row.one_by_one)}};
}

}  // namespace

json to_json(const SimulateReport& report) {
    const SimulateCase& what = report.what;
    json rows = json::array(), bars = json::array();
    for (const SimulateRow& row : report.rows) rows.push_back(row_json(report, row));
    for (const SimulateBar& bar : report.bars)
        bars.push_back(
            {{"ranks", bar.ranks}, {"efficiency", bar.efficiency}, {"met", report.met(bar)}});
    return {{"format", "mpipov-simulation"},
            {"version", 1},
            {"image", {{"width", what.width}, {"height", what.height}}},
            {"region", rect_json(what.grid.region)},
            {"costs", {{"from", what.costs_from}, {"cpu_seconds", what.costs.cpu_seconds()}}},
            {"serial_seconds", what.serial_seconds()},
            {"schedule", to_string(what.policy)},
            {"threads", what.threads},
            {"slots", what.slots},
            {"speeds", what.speeds},
            {"ranks_per_host", what.ranks_per_host},
            {"dedicated", what.dedicated},
            {"terms", terms_json(what.terms)},
            {"rows", rows},
            {"bars", bars}};
}

json to_json(const PaperReport& report) {
    json rows = json::array(), cells = json::array();
    for (const PaperRow& row : report.rows)
        rows.push_back({{"ranks", row.ranks},
                        {"mpipov1", row.mpipov1},
                        {"mpipov2", number_json(row.mpipov2)},
                        {"ours", row.ours},
                        {"ours_launched", row.ours_launched}});
    for (const auto& [cell, model] : report.cells)
        cells.push_back({{"version", cell.version},
                         {"ranks", cell.ranks},
                         {"paper", cell.speedup},
                         {"model", model},
                         {"fitted", cell.fitted && report.latency_fitted}});
    return {
        {"format", "mpipov-paper"},
        {"version", 1},
        {"image",
         {{"width", report.costs.region().width()}, {"height", report.costs.region().height()}}},
        {"costs", {{"from", report.costs_from}, {"cpu_seconds", report.costs.cpu_seconds()}}},
        {"latency", report.machine.latency},
        {"latency_fitted", report.latency_fitted},
        {"bytes_per_second", report.machine.bytes_per_second},
        {"strips", report.strips ? json(*report.strips) : json()},
        {"rows", rows},
        {"cells", cells},
        {"terms", terms_json(report.terms)},
        {"serial_wanted", number_json(report.serial_wanted)}};
}

}  // namespace mpipov
