#include "job_identity.h"

#include "fingerprint.h"
#include "scene_files.h"
#include "scene_view.h"
#include "sha1_digits.h"

#include <OpenImageIO/hash.h>
#include <fmt/format.h>

#include <array>
#include <set>

namespace mpipov {
namespace {

using nlohmann::json;

constexpr const char* settings_key = "settings";
constexpr const char* files_key = "files";
// In which order differences are told: of those that follow from each other, the one that a user
// would look for first.
constexpr std::array order{"POV-Ray version", settings_key, "image size", "region", files_key};

// What the probe adds to the user's own.
bool is_ours(const std::string& key) {
    return key == "Create_Ini" || key == "Include_Header";
}

json settings_of(const IniSettings& settings) {
    json out = json::object();
    for (const auto& [key, value] : settings) {
        if (is_ours(key)) continue;
        if (!out.contains(key))
            out[key] = value;
        else  // Declare, Library_Path
            out[key] = out[key].get<std::string>() + ", " + value;
    }
    return out;
}

// Of a file that is not read as a whole the time of change too: that it was written to between the
// pieces must not be missed.
std::string state_of(const std::filesystem::path& file) {
    std::string state = fingerprint(file);
    std::error_code error;
    if (state.empty() || is_of_whole_file(state)) return state;
    const auto changed = std::filesystem::last_write_time(file, error).time_since_epoch().count();
    return fmt::format("{}, changed {}", state, changed);
}

json files_of(const Probe& probe, const std::vector<std::string>& arguments) {
    json files = json::object();
    for (const std::filesystem::path& file : scene_files(scene_request(probe, arguments)))
        files[file.string()] = state_of(file);
    return files;
}

std::string text_of(const json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

json member(const json& object, const std::string& key) {
    return object.is_object() ? object.value(key, json()) : json();
}

std::string change_of_file(const std::string& file, const json& before, const json& after) {
    return fmt::format("'{}' {}", file,
                       before.is_null()  ? "was added"
                       : after.is_null() ? "is no longer there"
                                         : "changed");
}

std::string change_of(const std::string& name, const json& before, const json& after) {
    return fmt::format("{} changed from {} to {}", name,
                       before.is_null() ? "nothing" : text_of(before),
                       after.is_null() ? "nothing" : text_of(after));
}

std::set<std::string> keys_of(const json& a, const json& b) {
    std::set<std::string> keys;
    for (const json* object : {&a, &b})
        if (object->is_object())
            for (const auto& [key, value] : object->items()) keys.insert(key);
    return keys;
}

}  // namespace

json job_identity(const Probe& probe, const std::vector<std::string>& arguments,
                  const std::string& povray_version) {
    const ImageOptions& image = probe.result.image;
    const Rect& region = image.region;
    return {{order[0], povray_version},
            {settings_key, settings_of(probe.settings)},
            {"image size", fmt::format("{} x {}", image.width, image.height)},
            {"region", fmt::format("columns {} to {}, rows {} to {}", region.x0 + 1, region.x1,
                                   region.y0 + 1, region.y1)},
            {files_key, files_of(probe, arguments)},
            {"arguments", fmt::format("'{}'", fmt::join(arguments, " "))}};
}

std::string scene_sha1(const json& identity) {
    return sha1_of_text(identity.at(files_key).dump());
}

std::vector<std::filesystem::path> files_of_scene(const json& identity) {
    std::vector<std::filesystem::path> files;
    for (const auto& [name, sha1] : identity.at(files_key).items()) files.emplace_back(name);
    return files;
}

std::string what_changed(const json& earlier, const json& now) {
    std::vector<std::string> keys(order.begin(), order.end());
    for (const std::string& key : keys_of(earlier, now))
        if (std::find(order.begin(), order.end(), key) == order.end()) keys.push_back(key);
    for (const std::string& key : keys) {
        const json before = member(earlier, key), after = member(now, key);
        if (before == after) continue;
        if (key != files_key && key != settings_key) return change_of("the " + key, before, after);
        for (const std::string& name : keys_of(before, after)) {
            const json one = member(before, name), other = member(after, name);
            if (one == other) continue;
            return key == files_key ? change_of_file(name, one, other)
                                    : change_of(name, one, other);
        }
        return change_of("the " + key, before, after);
    }
    return {};
}

}  // namespace mpipov
