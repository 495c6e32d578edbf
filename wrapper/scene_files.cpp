#include "scene_files.h"

#include "letter_case.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <deque>
#include <fstream>
#include <map>
#include <set>
#include <system_error>
#include <unordered_set>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t most_scanned_bytes = std::uintmax_t{64} << 20;
// POV-Ray tries these, and the same in capitals, for a name without an extension.
constexpr std::array extensions{".pov", ".inc", ".ini", ".tga",  ".gif", ".iff",  ".pgm",
                                ".ppm", ".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp",
                                ".exr", ".hdr", ".ttf", ".sys",  ".df3"};

bool is_blank(char c) {
    return std::isspace(static_cast<unsigned char>(c)) != 0;
}

std::string_view trim(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::string_view unquoted(std::string_view text) {
    text = trim(text);
    if (text.size() >= 2 && text.front() == text.back() &&
        (text.front() == '"' || text.front() == '\''))
        return text.substr(1, text.size() - 2);
    return text;
}

// Where the comment ends that begins at `at`, `at` itself where there is none.
std::size_t after_comment(std::string_view text, std::size_t at) {
    if (text.compare(at, 2, "//") == 0) return std::min(text.find('\n', at), text.size());
    if (text.compare(at, 2, "/*") != 0) return at;
    int depth = 0;  // they nest
    while (at < text.size()) {
        if (text.compare(at, 2, "/*") == 0) {
            ++depth;
            at += 2;
        } else if (text.compare(at, 2, "*/") == 0) {
            at += 2;
            if (--depth == 0) return at;
        } else {
            ++at;
        }
    }
    return at;
}

struct Literal {
    std::string text;
    std::size_t end = 0;  // behind its closing mark, or where it was given up
    bool complete = false;
};

// A file's name ends within its line: behind a stray mark the next line begins anew.
Literal read_literal(std::string_view text, std::size_t at) {
    Literal literal;
    for (++at; at < text.size() && text[at] != '\n'; ++at) {
        if (text[at] == '"') {
            literal.complete = true;
            ++at;
            break;
        }
        // In names a backslash stands for itself, but for one before a quotation mark.
        if (text[at] == '\\' && at + 1 < text.size() && text[at + 1] == '"') ++at;
        literal.text += text[at];
    }
    literal.end = at;
    return literal;
}

// #fopen HANDLE "file" write: the scene makes this file itself.
bool is_to_be_written(std::string_view behind) {
    while (!behind.empty() && is_blank(behind.front())) behind.remove_prefix(1);
    for (const std::string_view word : {"write", "append"})
        if (behind.substr(0, word.size()) == word &&
            (behind.size() == word.size() ||
             std::isalnum(static_cast<unsigned char>(behind[word.size()])) == 0))
            return true;
    return false;
}

// A name that is no option and no setting: a scene or an INI file, with or without [section].
std::string_view without_section(std::string_view name) {
    const auto bracket = name.rfind('[');
    return bracket != std::string_view::npos && name.back() == ']' ? name.substr(0, bracket) : name;
}

std::string_view name_in_word(std::string_view word) {
    word = trim(word);
    if (word.empty()) return {};
    if (word[0] == '+' || word[0] == '-') {
        const std::string option = lower(word.substr(1, 2));
        if (option == "hi") return unquoted(word.substr(3));
        return option[0] == 'i' ? unquoted(word.substr(2)) : std::string_view();
    }
    const auto equals = word.find('=');
    if (equals == std::string_view::npos || word[0] == '"' || word[0] == '\'')
        return without_section(unquoted(word));
    const std::string key = lower(trim(word.substr(0, equals)));
    return key == "include_header" || key == "input_file_name" ? unquoted(word.substr(equals + 1))
                                                               : std::string_view();
}

std::vector<std::string> names_in_ini(std::string_view text) {
    std::vector<std::string> names;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string_view line = text.substr(at, end - at);
        line = line.substr(0, line.find(';'));
        for (std::string& name : names_in_option(line)) names.push_back(std::move(name));
        at = end + 1;
    }
    return names;
}

// All of it; empty where it is no text that could name other files.
std::string text_of(const fs::path& file) {
    std::error_code error;
    const auto size = fs::file_size(file, error);
    if (error || size > most_scanned_bytes) return {};
    std::string text(static_cast<std::size_t>(size), '\0');
    std::ifstream in(file, std::ios::binary);
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, in.gcount())));
    return text.find('\0') == std::string::npos ? text : std::string();
}

bool is_ascii(std::string_view text) {
    return std::all_of(text.begin(), text.end(),
                       [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

// Of no size or endless, and nothing that a picture is made of.
bool is_the_kernels(const fs::path& canonical) {
    for (const char* folder : {"/proc/", "/sys/", "/dev/"})
        if (canonical.string().rfind(folder, 0) == 0) return true;
    return false;
}

class Search {
  public:
    explicit Search(const SceneRequest& request) {
        folders_.emplace_back();  // of the run
        folders_.insert(folders_.end(), request.library_paths.begin(), request.library_paths.end());
        std::error_code ignored;
        output_ = fs::weakly_canonical(request.output, ignored);
        for (const std::string& option : request.options) look_for_all(names_in_option(option));
        look_for(request.scene);
        // Where the scene lies is known now. POV-Ray itself looks there only where +L says so.
        const std::vector<fs::path> found(to_scan_.begin(), to_scan_.end());
        for (const fs::path& file : found)
            if (!is_ini(file)) folders_.push_back(file.parent_path());
        names_.clear();
        while (!to_scan_.empty()) {
            const fs::path file = to_scan_.front();
            to_scan_.pop_front();
            const bool ini = is_ini(file);
            in_text_ = !ini;
            look_for_all(ini ? names_in_ini(text_of(file)) : names_in_scene(text_of(file)));
        }
    }

    SceneNames all_names() const {
        return {{named_.begin(), named_.end()}, {absolute_.begin(), absolute_.end()}};
    }

    std::vector<fs::path> files() const {
        std::vector<fs::path> files;
        for (const auto& [canonical, named] : files_) files.push_back(named);
        std::sort(files.begin(), files.end());
        return files;
    }

  private:
    void look_for_all(const std::vector<std::string>& names) {
        for (const std::string& name : names)
            if (names_.insert(name).second) look_for(name);
    }

    void look_for(const std::string& name) {
        if (name.empty()) return;
        absolute_name_ = in_text_ && fs::path(name).is_absolute();
        for (const fs::path& folder : folders_)
            for (const fs::path& file : files_tried_for(folder / name)) take(file);
    }

    void take(const fs::path& file) {
        // POV-Ray makes blanks of what is not ASCII, and finds no such file (docs/povray.md).
        if (!is_ascii(file.native())) return;
        std::error_code error;
        if (!fs::is_regular_file(file, error)) return;
        const fs::path canonical = fs::canonical(file, error);
        if (error || canonical == output_ || is_povrays_own(canonical) || is_the_kernels(canonical))
            return;
        named_.insert(file);
        if (absolute_name_) absolute_.insert(file);
        if (files_.emplace(canonical, file).second) to_scan_.push_back(file);
    }

    std::vector<fs::path> folders_;
    fs::path output_;
    std::set<std::string> names_;         // looked for already
    std::map<fs::path, fs::path> files_;  // canonical -> as it was named
    std::deque<fs::path> to_scan_;
    std::set<fs::path> named_, absolute_;
    bool in_text_ = false, absolute_name_ = false;  // what is looked for
};

}  // namespace

std::vector<std::string> names_in_scene(std::string_view text) {
    std::vector<std::string> names;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t behind = after_comment(text, at);
        if (behind != at) {
            at = behind;
        } else if (text[at] == '"') {
            Literal literal = read_literal(text, at);
            at = literal.end;
            if (literal.complete && !literal.text.empty() && !is_to_be_written(text.substr(at)))
                names.push_back(std::move(literal.text));
        } else {
            ++at;
        }
    }
    return names;
}

bool is_ini(const std::filesystem::path& file) {
    return lower(file.extension().string()) == ".ini";
}

std::vector<std::string_view> readings_of(std::string_view option) {
    std::vector<std::string_view> readings{option};
    for (std::size_t at = 0; at < option.size();) {
        const std::size_t end = std::min(option.find_first_of(" \t", at), option.size());
        readings.push_back(option.substr(at, end - at));
        at = end + 1;
    }
    return readings;
}

std::vector<std::string> names_in_option(std::string_view option) {
    std::vector<std::string> names;
    std::unordered_set<std::string_view> known;
    const auto add = [&](std::string_view name) {
        if (!name.empty() && known.insert(name).second) names.emplace_back(name);
    };
    for (const std::string_view words : readings_of(option)) add(name_in_word(words));
    return names;
}

std::vector<std::filesystem::path> scene_files(const SceneRequest& request) {
    return Search(request).files();
}

SceneNames scene_names(const SceneRequest& request) {
    return Search(request).all_names();
}

std::vector<fs::path> files_tried_for(const fs::path& name) {
    std::vector<fs::path> files{name.lexically_normal()};
    if (name.has_extension()) return files;
    const std::string bare = files.front().string();
    for (const char* extension : extensions) {
        files.emplace_back(bare + extension);
        files.emplace_back(bare + upper(extension));
    }
    return files;
}

bool is_povrays_own(const std::filesystem::path& file) {
    const auto own = [](const fs::path& folder, const fs::path& inside) {
        return folder == "share" && inside.string().rfind("povray-3.", 0) == 0;
    };
    return std::adjacent_find(file.begin(), file.end(), own) != file.end();
}

}  // namespace mpipov
