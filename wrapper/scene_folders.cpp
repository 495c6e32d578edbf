#include "scene_folders.h"

#include "inside.h"
#include "letter_case.h"
#include "scene_files.h"
#include "user_settings.h"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <set>
#include <system_error>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

std::string_view unquoted(std::string_view text) {
    constexpr const char* blanks = " \t\r\n";
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    text = text.substr(0, text.find_last_not_of(blanks) + 1);
    if (text.size() >= 2 && text.front() == text.back() &&
        (text.front() == '"' || text.front() == '\''))
        return text.substr(1, text.size() - 2);
    return text;
}

struct Spelling {
    std::string_view letters, key;  // without + or -; lower case
};
constexpr Spelling library_path{"l", "library_path"};
constexpr Spelling cache_file{"rf", "radiosity_file_name"};
constexpr Spelling output_file{"o", "output_file_name"};

std::string_view value_in_word(std::string_view word, const Spelling& spelling) {
    word = unquoted(word);
    if (word.empty()) return {};
    if (word[0] == '+' || word[0] == '-') {
        if (lower(word.substr(1, spelling.letters.size())) != spelling.letters) return {};
        return unquoted(word.substr(1 + spelling.letters.size()));
    }
    const auto equals = word.find('=');
    if (equals == std::string_view::npos || lower(unquoted(word.substr(0, equals))) != spelling.key)
        return {};
    return unquoted(word.substr(equals + 1));
}

std::vector<std::string> values_in(std::string_view option, const Spelling& spelling) {
    std::vector<std::string> values;
    const auto add = [&](std::string_view word) {
        const std::string_view value = value_in_word(word, spelling);
        if (!value.empty() && std::find(values.begin(), values.end(), value) == values.end())
            values.emplace_back(value);
    };
    for (const std::string_view words : readings_of(option)) add(words);
    return values;
}

std::vector<std::string> values_of(const fs::path& ini, const Spelling& spelling) {
    std::vector<std::string> values;
    std::ifstream in(ini);
    for (std::string line; std::getline(in, line);)
        for (std::string& value : values_in(line.substr(0, line.find(';')), spelling))
            values.push_back(std::move(value));
    return values;
}

class Folders {
  public:
    explicit Folders(const FolderRequest& request) : request_(request) {
        for (const std::string& argument : request.arguments) {
            for (const std::string& name : names_in_option(argument)) add_named(name);
            for (const std::string& name : caches_in(argument)) add_file(from_run(name));
            for (const std::string& folder : library_paths_in(argument)) add(from_run(folder));
        }
        if (!is_for_more_than_a_scene(request.run_folder, request.home)) add(request.run_folder);
        if (request.settings.empty()) return;
        paths_.insert(request.settings);
        for (const std::string& folder : library_paths_of(request.settings)) add(from_run(folder));
    }

    std::vector<fs::path> paths() const { return {paths_.begin(), paths_.end()}; }

  private:
    fs::path from_run(const std::string& name) const {
        return (request_.run_folder / name).lexically_normal();
    }

    void add(const fs::path& folder) {
        std::error_code error;
        if (fs::is_directory(folder, error)) paths_.insert(folder);
    }

    bool add_file(const fs::path& file) {
        std::error_code error;
        if (!fs::is_regular_file(file, error)) return false;
        paths_.insert(file);
        return true;
    }

    void add_named(const std::string& name) {
        std::error_code error;
        fs::path file = from_run(name);
        // A scene may be named without its extension.
        if (!fs::is_regular_file(file, error)) file += ".pov";
        if (!add_file(file)) return;
        if (!is_for_more_than_a_scene(file.parent_path(), request_.home)) {
            add(file.parent_path());
            return;
        }
        fs::directory_iterator it(file.parent_path(), error);
        for (; !error && it != fs::directory_iterator(); it.increment(error)) {
            std::error_code gone;
            const bool regular = it->symlink_status(gone).type() == fs::file_type::regular;
            if (regular && is_a_scenes_file(it->path())) paths_.insert(it->path());
        }
    }

    const FolderRequest& request_;
    std::set<fs::path> paths_;
};

}  // namespace

std::vector<std::string> library_paths_in(std::string_view option) {
    return values_in(option, library_path);
}

std::vector<std::string> library_paths_of(const fs::path& ini) {
    return values_of(ini, library_path);
}

std::vector<std::string> outputs_in(std::string_view option) {
    return values_in(option, output_file);
}

std::vector<std::string> outputs_of(const fs::path& ini) {
    return values_of(ini, output_file);
}

std::vector<std::string> caches_in(std::string_view option) {
    return values_in(option, cache_file);
}

bool is_for_more_than_a_scene(const fs::path& folder, const fs::path& home) {
    std::error_code error;
    const fs::path real = fs::weakly_canonical(folder, error);
    struct stat status {};
    if (::stat(folder.c_str(), &status) == 0 && (status.st_mode & S_ISVTX) != 0) return true;
    if (real == real.root_path()) return true;
    if (home.empty()) return false;
    return lies_in(fs::weakly_canonical(home, error), real);
}

bool is_a_scenes_file(const fs::path& file) {
    constexpr std::array kinds{".pov", ".inc", ".ini", ".mcr", ".tga",  ".gif", ".iff",
                               ".pgm", ".ppm", ".png", ".jpg", ".jpeg", ".tif", ".tiff",
                               ".bmp", ".exr", ".hdr", ".ttf", ".otf",  ".df3"};
    return std::find(kinds.begin(), kinds.end(), lower(file.extension().string())) != kinds.end();
}

FolderRequest request_of_user(std::vector<std::string> arguments) {
    const fs::path home = home_of_user();
    std::error_code error;
    return {std::move(arguments), fs::current_path(error), home, settings_of_user(home)};
}

bool may_be_read(const fs::path& file, const std::vector<fs::path>& readable) {
    std::error_code error;
    const fs::path real = fs::weakly_canonical(file, error);
    return std::ranges::any_of(readable, [&](const fs::path& one) {
        return lies_in(real, fs::weakly_canonical(one, error));
    });
}

std::vector<fs::path> scene_folders(const FolderRequest& request) {
    return Folders(request).paths();
}

}  // namespace mpipov
