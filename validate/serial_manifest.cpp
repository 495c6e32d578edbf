#include "serial_manifest.h"

#include "json_input.h"

#include <stdexcept>

namespace mpipov {
namespace {

using nlohmann::json;

ListedRender render_from(const json& j) {
    return {member<std::string>(j, "name"), member<std::vector<std::string>>(j, "argv"),
            member<std::string>(j, "image"), member<double>(j, "seconds"),
            member<double>(j, "cpu_seconds")};
}

std::string text_or_nothing(const json& object, const char* key) {
    return object.contains(key) ? member<std::string>(object, key) : std::string();
}

}  // namespace

SerialManifest manifest_from_json(const json& j) {
    SerialManifest manifest;
    manifest.arguments = member<std::vector<std::string>>(j, "arguments");
    manifest.wanted = member<int>(j, "wanted", 0);
    manifest.method_1 = member<bool>(j, "method_1");
    for (const auto& [name, render] : member(j, "references").items())
        manifest.references.emplace(name, render_from(render));
    if (!manifest.references.contains("default"))
        throw std::runtime_error("its 'references' lack 'default'");
    const json& noise = member(j, "noise");
    manifest.exact = member<bool>(j, "exact");
    manifest.tried = member<int>(noise, "tried", 0);
    manifest.why_not = text_or_nothing(noise, "why_not");
    if (manifest.why_not.empty()) manifest.why_not = text_or_nothing(noise, "why_not_enough");
    if (noise.contains("renders"))
        for (const json& render : noise.at("renders"))
            manifest.renders.push_back(render_from(render));
    manifest.identity = member(j, "identity");
    return manifest;
}

}  // namespace mpipov
