#include "scene_pack.h"

#include "message_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>

namespace mpipov {
namespace {

[[noreturn]] void refuse(const std::string& what) {
    throw std::runtime_error("a packed scene is refused: " + what);
}

constexpr std::size_t sha1_length = 40;
// Of a file; what a pack may take is a limit of its own.
constexpr std::int64_t most_bytes = std::numeric_limits<std::int64_t>::max();

bool is_sha1(std::string_view text) {
    return text.size() == sha1_length &&
           text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

bool has_control_characters(std::string_view name) {
    return std::ranges::any_of(name, [](char c) { return (c >= '\0' && c < ' ') || c == '\x7f'; });
}

void check_name(const std::string& name, const PackLimits& limits) {
    if (name.size() > limits.name_bytes)
        refuse(fmt::format("a name of {} bytes, and the limit is {}: '{}...'", name.size(),
                           limits.name_bytes, name.substr(0, 40)));
    if (!stays_inside(name)) refuse(fmt::format("'{}' could lead out of its folder", name));
    if (has_control_characters(name))
        refuse(fmt::format("'{}' has a control character: give it another name", name));
}

void require_members(const nlohmann::json& json, const std::set<std::string>& members) {
    if (!json.is_object()) refuse("its list is damaged");
    for (const auto& [key, value] : json.items())
        if (members.count(key) == 0) refuse(fmt::format("'{}' is nothing that a pack holds", key));
}

// Of these sorted entries and the folders that they imply: of a name only what it does not share
// with the one before it is new. A few long names could else make millions of folders.
std::size_t count_of_all(const std::vector<std::string>& entries) {
    std::size_t count = 0;
    std::string_view before;
    for (const std::string_view entry : entries) {
        const auto differs = std::ranges::mismatch(entry, before).in1;
        count += static_cast<std::size_t>(std::count(differs, entry.end(), '/'));
        if (!entry.ends_with('/') && differs != entry.end()) ++count;
        before = entry;
    }
    return count;
}

bool has_folder(const std::vector<std::string>& entries, const std::string& name) {
    const auto found = std::ranges::lower_bound(entries, name + '/');
    return found != entries.end() && found->starts_with(name + '/');
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
    const auto require_few = [&](std::size_t names) {
        if (names > limits.names)
            refuse(fmt::format("it has {} files and folders, and the limit is {}", names,
                               limits.names));
    };
    require_few(pack.files.size() + pack.folders.size());
    // A folder ends with '/': so all that is in one comes right behind it, and nothing else.
    std::vector<std::string> entries;
    std::size_t name_bytes = 0;
    std::uint64_t left = limits.bytes;
    for (const std::string& folder : pack.folders) {
        check_name(folder, limits);
        name_bytes += folder.size();
        entries.push_back(folder + '/');
    }
    for (const PackedFile& file : pack.files) {
        check_name(file.name, limits);
        name_bytes += file.name.size();
        if (!is_sha1(file.sha1)) refuse(fmt::format("'{}' has no SHA-1", file.name));
        // Not added up first: a sum could overflow.
        if (file.bytes > left)
            refuse(fmt::format("with '{}' it takes more than {} bytes, which is the limit",
                               file.name, limits.bytes));
        left -= file.bytes;
        entries.push_back(file.name);
    }
    if (name_bytes > limits.all_name_bytes)
        refuse(fmt::format("its names take {} bytes, and the limit is {}", name_bytes,
                           limits.all_name_bytes));
    std::ranges::sort(entries);
    require_few(count_of_all(entries));
    for (std::size_t i = 1; i < entries.size(); ++i)
        if (entries[i] == entries[i - 1] && !entries[i].ends_with('/'))
            refuse(fmt::format("'{}' comes twice", entries[i]));
    for (const PackedFile& file : pack.files)
        if (has_folder(entries, file.name))
            refuse(fmt::format("'{}' is a file and a folder", file.name));
    if (!has_folder(entries, pack.folder)) refuse("it lacks the folder to run in");
    if (pack.ini.ends_with('/') || !std::ranges::binary_search(entries, pack.ini))
        refuse("it lacks its povray.ini");
}

nlohmann::json to_json(const ScenePack& pack) {
    nlohmann::json files = nlohmann::json::array();
    for (const PackedFile& file : pack.files)
        files.push_back(
            {{"name", text_to_json(file.name)}, {"bytes", file.bytes}, {"sha1", file.sha1}});
    return {{"files", std::move(files)},
            {"folders", texts_to_json(pack.folders)},
            {"folder", text_to_json(pack.folder)},
            {"ini", text_to_json(pack.ini)}};
}

ScenePack pack_from_json(const nlohmann::json& json) {
    require_members(json, {"files", "folders", "folder", "ini"});
    const MessageFields fields(json);
    ScenePack pack;
    for (const nlohmann::json& file : fields.array("files")) {
        // Who sends a kind, a link's target or a mode means something that is not unpacked.
        require_members(file, {"name", "bytes", "sha1"});
        const MessageFields about(file);
        pack.files.push_back(
            {about.text("name"), about.size("bytes", most_bytes), about.text("sha1")});
    }
    pack.folders = fields.texts("folders");
    pack.folder = fields.text("folder");
    pack.ini = fields.text("ini");
    return pack;
}

}  // namespace mpipov
