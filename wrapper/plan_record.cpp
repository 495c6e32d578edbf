// The part of a run's record that says how it is rendered.
#include "rect_corners.h"
#include "run_record.h"

#include <fmt/format.h>

#include <initializer_list>
#include <stdexcept>

namespace mpipov {
namespace {

using nlohmann::json;

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
        Effect effect{member<bool>(value, "on"), member<std::string>(value, "why"), {}};
        if (!member(value, "cpu_seconds").is_null())
            effect.cpu_seconds = member<double>(value, "cpu_seconds");
        effects.emplace(name, std::move(effect));
    }
    return effects;
}

json radiosity_json(const RadiositySharing& radiosity) {
    return {{"sharing", to_string(radiosity.how)},
            {"passes", radiosity.passes},
            {"scale", radiosity.scale}};
}

// Nothing in the records of versions that knew one way only.
RadiositySharing radiosity_from(const json& plan) {
    const auto found = plan.find("radiosity");
    if (found == plan.end()) return {};
    return {enum_from(member(*found, "sharing"),
                      {Sharing::independent, Sharing::shared, Sharing::joined}),
            member<int>(*found, "passes", 1), member<int>(*found, "scale", 1)};
}

json cuts_json(const std::vector<Rect>& cuts) {
    json all = json::array();
    for (const Rect& cut : cuts) all.push_back(corners_json(cut));
    return all;
}

}  // namespace

json to_json(const PlanRecord& plan) {
    return {{"image",
             {{"width", plan.image.width},
              {"height", plan.image.height},
              {"type", plan.image.type},
              {"depth", plan.image.depth},
              {"channels", plan.image.channels}}},
            {"region", corners_json(plan.region)},
            {"effects", effects_json(plan.effects)},
            {"grid",
             {{"shape", to_string(plan.shape)},
              {"seams", to_string(plan.seams)},
              {"halo", plan.halo},
              {"block", plan.block},
              {"sections", plan.sections},
              {"cuts", cuts_json(plan.cuts)}}},
            {"radiosity", radiosity_json(plan.radiosity)},
            {"schedule", plan.schedule},
            {"threads", plan.threads},
            {"in_flight", plan.in_flight},
            {"predicted",
             {{"wall_seconds", plan.predicted.wall_seconds},
              {"cpu_seconds", plan.predicted.cpu_seconds}}}};
}

PlanRecord plan_from_json(const json& j) {
    PlanRecord plan;
    const json& image = member(j, "image");
    plan.image = {member<int>(image, "width", 0), member<int>(image, "height", 0),
                  member<int>(image, "channels", 0), member<std::string>(image, "type"),
                  member<std::string>(image, "depth")};
    plan.region = rect_from_corners(member(j, "region"));
    plan.effects = effects_from(member(j, "effects"));
    const json& grid = member(j, "grid");
    plan.shape = shape_from(member(grid, "shape"));
    plan.seams = seams_from(member(grid, "seams"));
    plan.halo = member<int>(grid, "halo", 0);
    plan.block = member<int>(grid, "block", 1);  // a divisor, as is radiosity's scale
    plan.sections = member<int>(grid, "sections", 1);
    for (const json& cut : grid.value("cuts", json::array()))
        plan.cuts.push_back(rect_from_corners(cut));
    plan.radiosity = radiosity_from(j);
    plan.schedule = member<std::string>(j, "schedule");
    plan.threads = member<int>(j, "threads");
    plan.in_flight = member<int>(j, "in_flight");
    plan.predicted = {member<double>(member(j, "predicted"), "wall_seconds"),
                      member<double>(member(j, "predicted"), "cpu_seconds")};
    return plan;
}

}  // namespace mpipov
