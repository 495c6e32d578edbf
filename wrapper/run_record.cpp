#include "run_record.h"

#include "json_input.h"
#include "part_file.h"
#include "rect_corners.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace mpipov {
namespace {

using nlohmann::json;

constexpr int format_version = 1;
// JSON has no such number; it is null there.
constexpr double infinite = std::numeric_limits<double>::infinity();

json section_json(const SectionRecord& s) {
    return {{"id", s.section.id},
            {"keep", corners_json(s.section.keep)},
            {"render", corners_json(s.section.render)},
            {"rank", s.rank},
            {"host", s.host},
            {"start", s.start},
            {"end", s.end},
            {"wall_seconds", s.wall_seconds},
            {"cpu_seconds", s.cpu_seconds},
            {"attempts", s.attempts},
            {"resumed", s.resumed}};
}

SectionRecord section_from(const json& j) {
    SectionRecord s;
    s.section = {member<int>(j, "id"), rect_from_corners(member(j, "keep")),
                 rect_from_corners(member(j, "render"))};
    s.rank = member<int>(j, "rank");
    s.host = member<std::string>(j, "host");
    s.start = member<double>(j, "start");
    s.end = member<double>(j, "end");
    s.wall_seconds = member<double>(j, "wall_seconds");
    s.cpu_seconds = member<double>(j, "cpu_seconds");
    s.attempts = member<int>(j, "attempts");
    s.resumed = member<bool>(j, "resumed");
    return s;
}

json sections_json(const std::vector<SectionRecord>& sections) {
    json all = json::array();
    for (const SectionRecord& section : sections) all.push_back(section_json(section));
    return all;
}

std::vector<SectionRecord> sections_from(const json& all) {
    std::vector<SectionRecord> sections;
    for (const json& section : all) sections.push_back(section_from(section));
    return sections;
}

json waves_json(const std::vector<WaveRecord>& waves) {
    json all = json::array();
    for (const WaveRecord& wave : waves)
        all.push_back({{"width", wave.width},
                       {"height", wave.height},
                       {"samples", wave.samples},
                       {"sections", sections_json(wave.sections)}});
    return all;
}

std::vector<WaveRecord> waves_from(const json& all) {
    std::vector<WaveRecord> waves;
    for (const json& wave : all)
        waves.push_back({member<int>(wave, "width"), member<int>(wave, "height"),
                         member<long long>(wave, "samples"),
                         sections_from(member(wave, "sections"))});
    return waves;
}

json seam_json(const SeamRecord& s) {
    return {{"a", s.seam.a},
            {"b", s.seam.b},
            {"vertical", s.seam.vertical},
            {"position", s.seam.position},
            {"from", s.seam.from},
            {"to", s.seam.to},
            {"checked", s.checked},
            {"differing", s.differing},
            {"max_difference", std::isfinite(s.max_difference) ? json(s.max_difference) : json()},
            {"halo", s.halo}};
}

SeamRecord seam_from(const json& j) {
    SeamRecord s;
    s.seam = {member<int>(j, "a"),           member<int>(j, "b"),       member<bool>(j, "vertical"),
              member<int>(j, "position", 0), member<int>(j, "from", 0), member<int>(j, "to", 0)};
    s.checked = member<bool>(j, "checked");
    s.differing = member<long long>(j, "differing");
    const json& largest = member(j, "max_difference");
    s.max_difference = largest.is_null() ? infinite : largest.get<double>();
    s.halo = member<int>(j, "halo");
    return s;
}

json ratio(double measured, double predicted) {
    return predicted > 0 ? json(measured / predicted) : json();
}

}  // namespace

json to_json(const RunRecord& record) {
    json ranks = json::array(), seams = json::array();
    for (const RankRecord& r : record.ranks)
        ranks.push_back({{"rank", r.rank},
                         {"host", r.host},
                         {"slots", r.slots},
                         {"sections", r.sections},
                         {"busy_seconds", r.busy_seconds}});
    for (const SeamRecord& s : record.seams) seams.push_back(seam_json(s));
    return {{"format", "mpipov-run"},
            {"version", format_version},
            {"complete", record.complete},
            {"versions", record.versions},
            {"command", record.command},
            {"started", record.started},
            {"scene_sha1", record.scene_sha1},
            {"output", {{"file", record.output.string()}, {"pixel_sha1", record.pixel_sha1}}},
            {"plan", to_json(record.plan)},
            {"ranks", ranks},
            {"waves", waves_json(record.waves)},
            {"sections", sections_json(record.sections)},
            {"seams", seams},
            {"repairs", sections_json(record.repairs)},
            // Of what --dry-run promised; above 1: it took longer.
            {"prediction",
             {{"wall_ratio", record.complete ? ratio(record.totals.wall_seconds,
                                                     record.plan.predicted.wall_seconds)
                                             : json()},
              {"cpu_ratio",
               record.complete ? ratio(record.totals.cpu_seconds, record.plan.predicted.cpu_seconds)
                               : json()}}},
            {"totals",
             {{"wall_seconds", record.totals.wall_seconds},
              {"cpu_seconds", record.totals.cpu_seconds},
              {"coordinator_cpu_seconds", record.totals.coordinator_cpu_seconds},
              {"launches", record.totals.launches},
              {"retries", record.totals.retries},
              {"copies", record.totals.copies}}},
            {"warnings", record.warnings}};
}

RunRecord run_from_json(const json& j) {
    try {
        if (member(j, "format") != "mpipov-run" || member(j, "version") != format_version)
            throw std::runtime_error(
                fmt::format("not an mpipov-run record of version {}", format_version));
        RunRecord record;
        record.complete = member<bool>(j, "complete");
        record.versions = member<std::map<std::string, std::string>>(j, "versions");
        record.command = member<std::vector<std::string>>(j, "command");
        record.started = member<std::string>(j, "started");
        record.output = member<std::string>(member(j, "output"), "file");
        record.scene_sha1 = j.value("scene_sha1", std::string());
        record.pixel_sha1 = member<std::string>(member(j, "output"), "pixel_sha1");
        record.plan = plan_from_json(member(j, "plan"));
        for (const json& r : member(j, "ranks"))
            record.ranks.push_back({member<int>(r, "rank"), member<std::string>(r, "host"),
                                    member<int>(r, "slots"), member<int>(r, "sections"),
                                    member<double>(r, "busy_seconds")});
        record.waves = waves_from(j.value("waves", json::array()));
        record.sections = sections_from(member(j, "sections"));
        for (const json& s : member(j, "seams")) record.seams.push_back(seam_from(s));
        record.repairs = sections_from(member(j, "repairs"));
        const json& totals = member(j, "totals");
        record.totals = {member<double>(totals, "wall_seconds"),
                         member<double>(totals, "cpu_seconds"),
                         member<double>(totals, "coordinator_cpu_seconds"),
                         member<int>(totals, "launches"),
                         member<int>(totals, "retries"),
                         totals.value("copies", 0)};
        record.warnings = member<std::vector<std::string>>(j, "warnings");
        return record;
    } catch (const json::exception& error) {
        throw std::runtime_error(fmt::format("not a run record: {}", plain_words(error.what())));
    }
}

RunRecord read_run_record(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error(fmt::format("cannot read '{}'", file.string()));
    try {
        return run_from_json(parse_json(in));
    } catch (const std::exception& error) {
        throw std::runtime_error(
            fmt::format("cannot read '{}': {}", file.string(), plain_words(error.what())));
    }
}

void write_run_record(const std::filesystem::path& file, const RunRecord& record) {
    write_whole(file, to_json(record).dump(2, ' ', false, json::error_handler_t::replace) + '\n');
}

}  // namespace mpipov
