#include "scene_pack.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace mpipov {
namespace {

[[noreturn]] void refuse(const std::string& what) {
    throw std::runtime_error("a packed scene is refused: " + what);
}

constexpr std::size_t sha1_length = 40;

bool is_sha1(std::string_view text) {
    return text.size() == sha1_length &&
           text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

void check_name(const std::string& name, const PackLimits& limits) {
    if (name.size() > limits.name_bytes)
        refuse(fmt::format("a name of {} bytes, and the limit is {}: '{}...'", name.size(),
                           limits.name_bytes, name.substr(0, 40)));
    if (!stays_inside(name)) refuse(fmt::format("'{}' could lead out of its folder", name));
    try {
        nlohmann::json(name).dump();
    } catch (const nlohmann::json::exception&) {
        refuse(fmt::format("'{}' is no UTF-8: give it another name", name));
    }
}

void require_members(const nlohmann::json& json, const std::set<std::string>& members) {
    if (!json.is_object()) refuse("its list is damaged");
    for (const auto& [key, value] : json.items())
        if (members.count(key) == 0) refuse(fmt::format("'{}' is nothing that a pack holds", key));
}

}  // namespace

bool stays_inside(std::string_view name) {
    if (name.find('\0') != std::string_view::npos) return false;
    for (std::size_t at = 0; at <= name.size();) {
        const std::size_t end = std::min(name.find('/', at), name.size());
        const std::string_view part = name.substr(at, end - at);
        if (part.empty() || part == "." || part == "..") return false;
        at = end + 1;
    }
    return true;
}

std::uint64_t bytes_of(const ScenePack& pack) {
    std::uint64_t sum = 0;
    for (const PackedFile& file : pack.files) sum += file.bytes;
    return sum;
}

void check(const ScenePack& pack, const PackLimits& limits) {
    const std::size_t names = pack.files.size() + pack.folders.size();
    if (names > limits.names)
        refuse(
            fmt::format("it has {} files and folders, and the limit is {}", names, limits.names));
    std::set<std::string> files, folders;
    std::size_t name_bytes = 0;
    std::uint64_t left = limits.bytes;
    for (const std::string& folder : pack.folders) {
        check_name(folder, limits);
        folders.insert(folder);
        name_bytes += folder.size();
    }
    for (const PackedFile& file : pack.files) {
        check_name(file.name, limits);
        name_bytes += file.name.size();
        if (!files.insert(file.name).second) refuse(fmt::format("'{}' comes twice", file.name));
        if (!is_sha1(file.sha1)) refuse(fmt::format("'{}' has no SHA-1", file.name));
        // Not added up first: a sum could overflow.
        if (file.bytes > left)
            refuse(fmt::format("with '{}' it takes more than {} bytes, which is the limit",
                               file.name, limits.bytes));
        left -= file.bytes;
    }
    if (name_bytes > limits.all_name_bytes)
        refuse(fmt::format("its names take {} bytes, and the limit is {}", name_bytes,
                           limits.all_name_bytes));
    for (const std::set<std::string>* all : {&files, &folders})
        for (const std::string& name : *all)
            for (auto slash = name.rfind('/'); slash != std::string::npos;
                 slash = slash == 0 ? std::string::npos : name.rfind('/', slash - 1))
                folders.insert(name.substr(0, slash));
    for (const std::string& file : files)
        if (folders.count(file) > 0) refuse(fmt::format("'{}' is a file and a folder", file));
    if (folders.count(pack.folder) == 0) refuse("it lacks the folder to run in");
    if (files.count(pack.ini) == 0) refuse("it lacks its povray.ini");
}

nlohmann::json to_json(const ScenePack& pack) {
    nlohmann::json files = nlohmann::json::array();
    for (const PackedFile& file : pack.files)
        files.push_back({{"name", file.name}, {"bytes", file.bytes}, {"sha1", file.sha1}});
    return {{"files", std::move(files)},
            {"folders", pack.folders},
            {"folder", pack.folder},
            {"ini", pack.ini}};
}

ScenePack pack_from_json(const nlohmann::json& json) {
    require_members(json, {"files", "folders", "folder", "ini"});
    try {
        ScenePack pack;
        for (const nlohmann::json& file : json.at("files")) {
            // Who sends a kind, a link's target or a mode means something that is not unpacked.
            require_members(file, {"name", "bytes", "sha1"});
            if (!file.at("bytes").is_number_unsigned()) refuse("a file's size is no number");
            pack.files.push_back({file.at("name"), file.at("bytes"), file.at("sha1")});
        }
        pack.folders = json.at("folders").get<std::vector<std::string>>();
        pack.folder = json.at("folder");
        pack.ini = json.at("ini");
        return pack;
    } catch (const nlohmann::json::exception& error) {
        refuse(fmt::format("its list is damaged ({})", error.what()));
    }
}

}  // namespace mpipov
