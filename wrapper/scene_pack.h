// A scene on its way to a host that does not have it: which files, under which names, and what is
// refused. Pure. A pack knows regular files and folders alone: no links, no devices, no owners, no
// compression; whoever unpacks it makes nothing else.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mpipov {

struct PackedFile {
    std::string name;  // any bytes; below the folder that is unpacked into, '/' between folders
    std::uint64_t bytes = 0;  // that will come
    std::string sha1;         // of them, 40 hexadecimal digits
};

struct ScenePack {
    std::vector<PackedFile> files;     // in the order in which their bytes come
    std::vector<std::string> folders;  // made even where no file lies in them
    std::string folder;                // POV-Ray's current folder, one of `folders`
    std::string ini;                   // of `files`: what POV-Ray reads as its povray.ini
};

struct PackLimits {
    std::size_t names = 20000;  // files and folders, those too that lie between
    std::uint64_t bytes = std::uint64_t{16} << 30;
    std::size_t name_bytes = 1000;                      // of one name
    std::size_t all_name_bytes = std::size_t{4} << 20;  // of all, so that they fit a message
};

// A name that cannot leave the folder it is put into: relative, and no part of it is empty, "." or
// "..".
bool stays_inside(std::string_view name);

// Throws std::runtime_error, which names what is refused, and the limit where it is one.
void check(const ScenePack& pack, const PackLimits& limits = {});

std::uint64_t bytes_of(const ScenePack& pack);

nlohmann::json to_json(const ScenePack& pack);
// Throws std::runtime_error where it is not what to_json() makes, member by member.
ScenePack pack_from_json(const nlohmann::json& json);

}  // namespace mpipov
