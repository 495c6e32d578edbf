#include "packing.h"

#include "failure.h"
#include "file_text.h"
#include "inside.h"
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

fs::path real_path(const fs::path& path) {
    std::error_code error;
    return fs::weakly_canonical(fs::absolute(path), error);
}

std::vector<fs::path> own_library_paths(const SceneRequest& request) {
    std::vector<fs::path> paths = request.library_paths;
    std::erase_if(paths, [](const fs::path& path) { return is_povrays_own(path); });
    return paths;
}

// What the user himself named may lie anywhere; what the scene names, only where he put the scene
// or pointed to.
class MayGo {
  public:
    explicit MayGo(const SceneRequest& request) {
        folders_.push_back(real_path("."));
        if (std::error_code error; fs::is_regular_file(request.scene, error))
            folders_.push_back(real_path(request.scene).parent_path());
        for (const fs::path& path : own_library_paths(request)) folders_.push_back(real_path(path));
        for (const std::string& option : request.options)
            for (const std::string& name : names_in_option(option))
                named_.push_back(real_path(name));
    }
    bool operator()(const fs::path& file) const {
        const fs::path real = real_path(file);
        return std::ranges::find(named_, real) != named_.end() ||
               std::ranges::any_of(folders_,
                                   [&](const fs::path& folder) { return lies_in(real, folder); });
    }

  private:
    std::vector<fs::path> folders_, named_;
};

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
                   const SceneView& ours, const PackLimits& limits) {
    Packing packing;
    packing.absolute = scene_names(request).absolute_in_text;
    const MayGo may_go(request);
    std::vector<fs::path> files;
    for (const auto& [named, sha1] : ours.files) {
        if (std::ranges::find(packing.absolute, fs::path(named)) != packing.absolute.end())
            continue;
        if (!may_go(named))
            throw Failure(
                Exit::file,
                fmt::format("'{}', which the scene names, is not sent to other hosts: it lies "
                            "neither in the current folder nor beside the scene nor in a library "
                            "path (+L)",
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
