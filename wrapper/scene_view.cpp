#include "scene_view.h"

#include "fingerprint.h"
#include "message_fields.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <system_error>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

fs::path in_environment(const char* name, const char* below) {
    const char* value = std::getenv(name);
    if (value == nullptr || *value == '\0') return {};
    return *below == '\0' ? fs::path(value) : fs::path(value) / below;
}

}  // namespace

SceneRequest scene_request(const Probe& probe, const std::vector<std::string>& arguments) {
    SceneRequest request;
    request.scene = probe.result.image.input_file;
    request.options = arguments;
    // POV-Ray reads one of them without being told to.
    request.options.emplace_back("povray.ini");
    for (const auto& [key, value] : probe.settings)
        if (key == "Library_Path") request.library_paths.emplace_back(value);
    request.output = probe.result.image.output_file;
    return request;
}

SceneView view_scene(const SceneRequest& request, const std::vector<fs::path>& more) {
    SceneView view;
    for (const fs::path& file : more)
        if (std::error_code error; fs::is_regular_file(file, error))
            view.files[file.string()] = fingerprint(file);
    for (const fs::path& file : scene_names(request).all)
        view.files[file.string()] = fingerprint(file);
    const fs::path ini = povray_ini();
    if (!ini.empty()) view.ini_sha1 = fingerprint(ini);
    return view;
}

std::string difference(const SceneView& ours, const SceneView& theirs) {
    for (const auto& [file, sha1] : ours.files) {
        const auto found = theirs.files.find(file);
        if (found == theirs.files.end()) return fmt::format("lacks '{}'", file);
        if (found->second != sha1) return fmt::format("has another '{}'", file);
    }
    for (const auto& [file, sha1] : theirs.files)
        if (ours.files.count(file) == 0)
            return fmt::format("has '{}', which rank 0 does not see", file);
    return ours.ini_sha1 == theirs.ini_sha1 ? "" : "has another povray.ini";
}

fs::path povray_ini() {
    for (const fs::path& file :
         {in_environment("POVINI", ""), fs::path("povray.ini"),
          in_environment("HOME", ".povray/3.7/povray.ini"), in_environment("HOME", ".povrayrc"),
          fs::path("/etc/povray/3.7/povray.ini"), fs::path("/etc/povray.ini")}) {
        std::error_code error;
        if (!file.empty() && fs::is_regular_file(file, error)) return file;
    }
    return {};
}

std::string point_of_view() {
    std::string boot;
    std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), boot);
    std::error_code error;
    const fs::path mounts = fs::read_symlink("/proc/self/ns/mnt", error);
    struct stat folder {};
    struct stat root {};
    if (::stat(".", &folder) != 0 || ::stat("/", &root) != 0) return {};
    return fmt::format("{} {} {}:{} {}:{}", boot, mounts.string(), root.st_dev, root.st_ino,
                       folder.st_dev, folder.st_ino);
}

nlohmann::json to_json(const SceneRequest& request) {
    nlohmann::json paths = nlohmann::json::array();
    for (const fs::path& path : request.library_paths) paths.push_back(text_to_json(path.string()));
    return {{"scene", text_to_json(request.scene)},
            {"options", texts_to_json(request.options)},
            {"library_paths", std::move(paths)},
            {"output", text_to_json(request.output.string())}};
}

SceneRequest scene_request_from_json(const nlohmann::json& json) {
    const MessageFields fields(json);
    SceneRequest request{fields.text("scene"), fields.texts("options"), {}, fields.text("output")};
    for (const std::string& path : fields.texts("library_paths"))
        request.library_paths.emplace_back(path);
    return request;
}

nlohmann::json to_json(const SceneView& view) {
    nlohmann::json files = nlohmann::json::array();
    for (const auto& [name, sha1] : view.files)
        files.push_back({{"name", text_to_json(name)}, {"sha1", sha1}});
    return {{"files", std::move(files)}, {"ini", view.ini_sha1}};
}

SceneView scene_view_from_json(const nlohmann::json& json) {
    const MessageFields fields(json);
    SceneView view{{}, fields.text("ini")};
    for (const nlohmann::json& file : fields.array("files")) {
        const MessageFields about(file);
        view.files[about.text("name")] = about.text("sha1");
    }
    return view;
}

}  // namespace mpipov
