#include "run_record.h"

#include "part_file.h"

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

json rect_json(const Rect& r) {
    return {{"x0", r.x0}, {"y0", r.y0}, {"x1", r.x1}, {"y1", r.y1}};
}

Rect rect_from(const json& j) {
    return {j.at("x0").get<int>(), j.at("y0").get<int>(), j.at("x1").get<int>(),
            j.at("y1").get<int>()};
}

template <typename Enum>
Enum enum_from(const json& j, std::initializer_list<Enum> values) {
    const auto text = j.get<std::string>();
    for (const Enum value : values)
        if (to_string(value) == text) return value;
    throw std::runtime_error(fmt::format("unknown value '{}'", text));
}

Shape shape_from(const json& j) {
    return enum_from(j, {Shape::columns, Shape::rows, Shape::tiles});
}

Seams seams_from(const json& j) {
    return enum_from(j, {Seams::aligned, Seams::halo, Seams::plain});
}

json effects_json(const std::map<std::string, Effect>& effects) {
    json out = json::object();
    for (const auto& [name, effect] : effects)
        out[name] = {{"on", effect.on},
                     {"why", effect.why},
                     {"cpu_seconds", effect.cpu_seconds ? json(*effect.cpu_seconds) : json()}};
    return out;
}

std::map<std::string, Effect> effects_from(const json& j) {
    std::map<std::string, Effect> effects;
    for (const auto& [name, value] : j.items()) {
        Effect effect{value.at("on").get<bool>(), value.at("why").get<std::string>(), {}};
        if (!value.at("cpu_seconds").is_null())
            effect.cpu_seconds = value.at("cpu_seconds").get<double>();
        effects.emplace(name, std::move(effect));
    }
    return effects;
}

json section_json(const SectionRecord& s) {
    return {{"id", s.section.id},
            {"keep", rect_json(s.section.keep)},
            {"render", rect_json(s.section.render)},
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
    s.section = {j.at("id").get<int>(), rect_from(j.at("keep")), rect_from(j.at("render"))};
    s.rank = j.at("rank").get<int>();
    s.host = j.at("host").get<std::string>();
    s.start = j.at("start").get<double>();
    s.end = j.at("end").get<double>();
    s.wall_seconds = j.at("wall_seconds").get<double>();
    s.cpu_seconds = j.at("cpu_seconds").get<double>();
    s.attempts = j.at("attempts").get<int>();
    s.resumed = j.at("resumed").get<bool>();
    return s;
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
    s.seam = {j.at("a").get<int>(),        j.at("b").get<int>(),    j.at("vertical").get<bool>(),
              j.at("position").get<int>(), j.at("from").get<int>(), j.at("to").get<int>()};
    s.checked = j.at("checked").get<bool>();
    s.differing = j.at("differing").get<long long>();
    const json& largest = j.at("max_difference");
    s.max_difference = largest.is_null() ? infinite : largest.get<double>();
    s.halo = j.at("halo").get<int>();
    return s;
}

json cuts_json(const std::vector<Rect>& cuts) {
    json all = json::array();
    for (const Rect& cut : cuts) all.push_back(rect_json(cut));
    return all;
}

json ratio(double measured, double predicted) {
    return predicted > 0 ? json(measured / predicted) : json();
}

}  // namespace

json to_json(const PlanRecord& plan) {
    return {{"image",
             {{"width", plan.image.width},
              {"height", plan.image.height},
              {"type", plan.image.type},
              {"depth", plan.image.depth},
              {"channels", plan.image.channels}}},
            {"region", rect_json(plan.region)},
            {"effects", effects_json(plan.effects)},
            {"grid",
             {{"shape", to_string(plan.shape)},
              {"seams", to_string(plan.seams)},
              {"halo", plan.halo},
              {"block", plan.block},
              {"sections", plan.sections},
              {"cuts", cuts_json(plan.cuts)}}},
            {"schedule", plan.schedule},
            {"threads", plan.threads},
            {"in_flight", plan.in_flight},
            {"predicted",
             {{"wall_seconds", plan.predicted.wall_seconds},
              {"cpu_seconds", plan.predicted.cpu_seconds}}}};
}

PlanRecord plan_from_json(const json& j) {
    PlanRecord plan;
    const json& image = j.at("image");
    plan.image = {image.at("width").get<int>(), image.at("height").get<int>(),
                  image.at("channels").get<int>(), image.at("type").get<std::string>(),
                  image.at("depth").get<std::string>()};
    plan.region = rect_from(j.at("region"));
    plan.effects = effects_from(j.at("effects"));
    const json& grid = j.at("grid");
    plan.shape = shape_from(grid.at("shape"));
    plan.seams = seams_from(grid.at("seams"));
    plan.halo = grid.at("halo").get<int>();
    plan.block = grid.at("block").get<int>();
    plan.sections = grid.at("sections").get<int>();
    for (const json& cut : grid.value("cuts", json::array())) plan.cuts.push_back(rect_from(cut));
    plan.schedule = j.at("schedule").get<std::string>();
    plan.threads = j.at("threads").get<int>();
    plan.in_flight = j.at("in_flight").get<int>();
    plan.predicted = {j.at("predicted").at("wall_seconds").get<double>(),
                      j.at("predicted").at("cpu_seconds").get<double>()};
    return plan;
}

json to_json(const RunRecord& record) {
    json ranks = json::array(), sections = json::array(), seams = json::array(),
         repairs = json::array();
    for (const RankRecord& r : record.ranks)
        ranks.push_back({{"rank", r.rank},
                         {"host", r.host},
                         {"slots", r.slots},
                         {"sections", r.sections},
                         {"busy_seconds", r.busy_seconds}});
    for (const SectionRecord& s : record.sections) sections.push_back(section_json(s));
    for (const SeamRecord& s : record.seams) seams.push_back(seam_json(s));
    for (const SectionRecord& s : record.repairs) repairs.push_back(section_json(s));
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
            {"sections", sections},
            {"seams", seams},
            {"repairs", repairs},
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
        if (j.at("format") != "mpipov-run" || j.at("version") != format_version)
            throw std::runtime_error(
                fmt::format("not an mpipov-run record of version {}", format_version));
        RunRecord record;
        record.complete = j.at("complete").get<bool>();
        record.versions = j.at("versions").get<std::map<std::string, std::string>>();
        record.command = j.at("command").get<std::vector<std::string>>();
        record.started = j.at("started").get<std::string>();
        record.output = j.at("output").at("file").get<std::string>();
        record.scene_sha1 = j.value("scene_sha1", std::string());
        record.pixel_sha1 = j.at("output").at("pixel_sha1").get<std::string>();
        record.plan = plan_from_json(j.at("plan"));
        for (const json& r : j.at("ranks"))
            record.ranks.push_back({r.at("rank").get<int>(), r.at("host").get<std::string>(),
                                    r.at("slots").get<int>(), r.at("sections").get<int>(),
                                    r.at("busy_seconds").get<double>()});
        for (const json& s : j.at("sections")) record.sections.push_back(section_from(s));
        for (const json& s : j.at("seams")) record.seams.push_back(seam_from(s));
        for (const json& s : j.at("repairs")) record.repairs.push_back(section_from(s));
        const json& totals = j.at("totals");
        record.totals = {totals.at("wall_seconds").get<double>(),
                         totals.at("cpu_seconds").get<double>(),
                         totals.at("coordinator_cpu_seconds").get<double>(),
                         totals.at("launches").get<int>(),
                         totals.at("retries").get<int>(),
                         totals.value("copies", 0)};
        record.warnings = j.at("warnings").get<std::vector<std::string>>();
        return record;
    } catch (const json::exception& error) {
        throw std::runtime_error(fmt::format("not a run record: {}", error.what()));
    }
}

RunRecord read_run_record(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error(fmt::format("cannot read '{}'", file.string()));
    try {
        return run_from_json(json::parse(in));
    } catch (const std::exception& error) {
        throw std::runtime_error(fmt::format("cannot read '{}': {}", file.string(), error.what()));
    }
}

void write_run_record(const std::filesystem::path& file, const RunRecord& record) {
    PartFile part(file);
    {
        std::ofstream out(part.path());
        out << to_json(record).dump(2, ' ', false, json::error_handler_t::replace) << '\n';
        if (!out.flush()) throw std::runtime_error(fmt::format("cannot write '{}'", file.string()));
    }
    part.take_place();
}

}  // namespace mpipov
