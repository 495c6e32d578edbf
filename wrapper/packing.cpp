#include "packing.h"

#include "failure.h"
#include "file_text.h"
#include "packed_paths.h"
#include "sha1_digits.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <system_error>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

constexpr const char* ini_name = "povray.ini";  // beside the copy of the file tree

std::vector<fs::path> own_library_paths(const SceneRequest& request) {
    std::vector<fs::path> paths = request.library_paths;
    std::erase_if(paths, [](const fs::path& path) { return is_povrays_own(path); });
    return paths;
}

void add(Packing& packing, const std::string& name, std::string text) {
    packing.pack.files.push_back({name, text.size(), sha1_of_text(text)});
    packing.sources.push_back({{}, std::move(text)});
}

void add_file(Packing& packing, const std::string& name, const fs::path& file,
              const std::string& sha1) {
    std::error_code error;
    const auto bytes = fs::file_size(file, error);
    if (error || sha1.empty())
        throw Failure(Exit::file, fmt::format("cannot read '{}', which the scene names, to send it "
                                              "to other hosts",
                                              file.string()));
    packing.pack.files.push_back({name, bytes, sha1});
    packing.sources.push_back({file, {}});
}

}  // namespace

Packing pack_scene(const SceneRequest& request, const std::vector<std::string>& arguments,
                   const SceneView& ours, const MayGo& may_go, const PackLimits& limits) {
    Packing packing;
    packing.absolute = scene_names(request).absolute_in_text;
    std::vector<fs::path> files;
    for (const auto& [named, sha1] : ours.files) {
        if (std::ranges::find(packing.absolute, fs::path(named)) != packing.absolute.end())
            continue;
        if (!may_go(named))
            throw Failure(
                Exit::file,
                fmt::format(
                    "'{}', which the scene names, is not sent to other hosts: it lies in no "
                    "folder of the scene's, of +L or of --allow-read",
                    named));
        files.emplace_back(named);
    }
    const std::vector<fs::path> libraries = own_library_paths(request);
    const PackedPaths paths(fs::current_path(), libraries, files);
    std::set<std::string> names;
    for (const fs::path& file : files) {
        const std::string name = paths.name_of(file);
        if (!names.insert(name).second) continue;  // once relative, once absolute
        std::string text = is_ini(file) ? text_of(file) : std::string();
        std::string mapped = paths.mapped_ini(text);
        if (mapped != text)
            add(packing, name, std::move(mapped));
        else
            add_file(packing, name, file, ours.files.at(file.string()));
    }
    // Whatever povray.ini a host has, it is rank 0's that counts; none is an empty one.
    const fs::path ini = povray_ini();
    add(packing, ini_name, ini.empty() ? std::string() : paths.mapped_ini(text_of(ini)));
    packing.pack.ini = ini_name;
    packing.pack.folder = paths.name_of("");
    packing.pack.folders.push_back(packing.pack.folder);
    for (const fs::path& path : libraries) packing.pack.folders.push_back(paths.name_of(path));
    for (const std::string& argument : arguments)
        packing.arguments.push_back(paths.mapped_option(argument));
    try {
        check(packing.pack, limits);
    } catch (const std::runtime_error& error) {
        throw Failure(Exit::file, error.what());
    }
    return packing;
}

}  // namespace mpipov
