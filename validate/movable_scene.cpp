#include "movable_scene.h"

#include "camera_move.h"
#include "failure.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <map>
#include <optional>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

std::optional<std::string> text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) return {};
    return std::string(std::istreambuf_iterator<char>(in), {});
}

class Copies {
  public:
    Copies(const std::vector<fs::path>& library_paths, fs::path folder,
           const std::function<bool(const fs::path&)>& may_read)
        : folder_(std::move(folder)), may_read_(may_read) {
        searched_.emplace_back();  // of the run
        searched_.insert(searched_.end(), library_paths.begin(), library_paths.end());
    }

    MovableScene make(const std::string& scene) {
        const auto file = find(scene, {"", ".pov", ".POV"});
        const auto text = file ? text_of(*file) : std::nullopt;
        if (!text) throw Failure(Exit::scene, fmt::format("cannot read the scene '{}'", scene));
        std::string changed = changed_text(*text);
        if (result_.moves_itself) return result_;
        if (result_.cameras == 0) changed += movable_default_camera();
        const fs::path copy = write(file->filename(), changed);
        result_.arguments = {fmt::format("+I\"{}\"", copy.string())};
        return result_;
    }

  private:
    std::optional<fs::path> find(const std::string& name,
                                 std::initializer_list<const char*> extensions) const {
        for (const fs::path& folder : searched_)
            for (const char* extension : extensions) {
                const fs::path file = folder / (name + extension);
                std::error_code error;
                if (fs::is_regular_file(file, error) && may_read_(file)) return file;
            }
        return {};
    }

    std::string changed_text(const std::string& text) {
        const SceneText read = read_scene_text(text);
        result_.cameras += read.cameras;
        result_.moves_itself = result_.moves_itself || read.moves_itself;
        std::map<std::string, std::string> others;
        for (const std::string& name : read.includes)
            if (const std::string other = copy_of(name); !other.empty()) others[name] = other;
        return read.cameras == 0 && others.empty() ? text : with_movable_camera(text, others);
    }

    // Its path; empty where no copy is needed.
    std::string copy_of(const std::string& name) {
        if (const auto known = copies_.find(name); known != copies_.end()) return known->second;
        std::string& copy = copies_[name];  // "" while it is being made: a file may include itself
        const auto file = find(name, {"", ".inc", ".INC", ".pov", ".POV"});
        const auto text = file ? text_of(*file) : std::nullopt;
        if (!text) return copy;
        const std::string changed = changed_text(*text);
        if (changed != *text)
            copy = write(fmt::format("{}-{}", copies_.size(), file->filename().string()), changed)
                       .string();
        return copy;
    }

    fs::path write(const fs::path& name, const std::string& text) const {
        std::error_code ignored;
        fs::create_directories(folder_, ignored);
        fs::path file = folder_ / name;
        std::ofstream out(file, std::ios::binary);
        out << text;
        out.close();
        if (!out) throw Failure(Exit::file, fmt::format("cannot write '{}'", file.string()));
        return file;
    }

    fs::path folder_;
    const std::function<bool(const fs::path&)>& may_read_;
    std::vector<fs::path> searched_;
    std::map<std::string, std::string> copies_;  // by the name that includes them
    MovableScene result_;
};

}  // namespace

MovableScene make_movable(const std::string& scene, const std::vector<fs::path>& library_paths,
                          const fs::path& folder,
                          const std::function<bool(const fs::path&)>& may_read) {
    return Copies(library_paths, folder, may_read).make(scene);
}

}  // namespace mpipov
