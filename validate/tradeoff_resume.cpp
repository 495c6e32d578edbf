#include "job_identity.h"
#include "journal.h"
#include "run_image.h"
#include "tradeoff_report.h"

#include <fmt/format.h>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

fs::path existing(const TradeoffReport& report, const json& name) {
    if (!name.is_string()) return {};
    const fs::path file = report.folder / name.get<std::string>();
    std::error_code none;
    return fs::is_regular_file(file, none) ? file : fs::path();
}

void take_row(TradeoffReport& report, TradeoffRow& row, const json& earlier) {
    if (earlier.at("argv") != json(row.argv) || !earlier.at("failure").is_null()) return;
    const fs::path image = existing(report, earlier.at("image"));
    const auto wall = earlier.at("wall").get<std::vector<double>>();
    const auto cpu = earlier.at("cpu").get<std::vector<double>>();
    if (image.empty() || wall.empty() || wall.size() != cpu.size()) return;
    if (pixel_sha1(image) != earlier.at("pixel_sha1")) return;
    row.wall = wall;
    row.cpu = cpu;
    row.image = image;
    row.pixel_sha1 = earlier.at("pixel_sha1").get<std::string>();
    row.varies = earlier.at("varies").get<bool>();
    if (!earlier.at("sections").is_null()) row.sections = earlier.at("sections").get<int>();
    if (!report.image) report.image = ImageSource(image).format();
}

void take_truth(TradeoffReport& report, const json& earlier) {
    if (earlier.is_null()) return;
    Truth truth;
    truth.image = existing(report, earlier.at("image"));
    truth.other = existing(report, earlier.at("other"));
    if (truth.image.empty() || truth.other.empty()) return;
    // A picture that was cut short, or that is of a run that was killed before it said so here.
    for (const auto& [file, key] :
         {std::pair{truth.image, "image_sha1"}, std::pair{truth.other, "other_sha1"}})
        if (sha1_of_file(file) != earlier.value(key, sha1_of_file(file))) return;
    const auto full_scale = [&](const char* key) { return earlier.at(key).get<double>() / 255; };
    truth.depth = earlier.at("depth").get<int>();
    truth.argv = earlier.at("argv").get<std::vector<std::vector<std::string>>>();
    truth.wall_seconds = earlier.at("wall_seconds").get<double>();
    truth.cpu_seconds = earlier.at("cpu_seconds").get<double>();
    truth.sampling_error = full_scale("sampling_error");
    truth.rounding_error = full_scale("rounding_error");
    report.truth = truth;
}

}  // namespace

std::string what_changed_since(const TradeoffReport& report, const json& earlier) {
    const json now = to_json(report);
    if (const std::string changed = what_changed(earlier.at("identity"), report.identity);
        !changed.empty())
        return changed;
    for (const char* key : {"versions", "host"})
        if (earlier.at(key) != now.at(key))
            return fmt::format("'{}' was {}, is {}", key, earlier.at(key).dump(),
                               now.at(key).dump());
    return {};
}

void take_measured(TradeoffReport& report, const json& earlier) {
    for (TradeoffRow& row : report.rows)
        for (const json& one : earlier.at("rows"))
            if (one.at("name") == row.setting.name) take_row(report, row, one);
    if (earlier.at("averaging") == to_json(report).at("averaging"))
        take_truth(report, earlier.at("truth"));
}

}  // namespace mpipov
