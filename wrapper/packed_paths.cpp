#include "packed_paths.h"

#include "scene_files.h"

#include <algorithm>
#include <array>
#include <regex>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

constexpr const char* top = "scene";  // of the pack: the root itself has no name

fs::path common_part(const fs::path& a, const fs::path& b) {
    fs::path common;
    for (auto x = a.begin(), y = b.begin(); x != a.end() && y != b.end() && *x == *y; ++x, ++y)
        common /= *x;
    return common;
}

fs::path without_slash(const fs::path& path) {
    return path.has_filename() || path == path.root_path() ? path : path.parent_path();
}

// A setting whose value is a file that is read or a folder to look for files in: all of the line.
const std::regex& setting() {
    static const std::regex shape(
        R"(^(\s*(?:library_path|input_file_name|include_header|radiosity_file_name)\s*=\s*)(\S.*?)(\s*)$)",
        std::regex::icase);
    return shape;
}

// The same as an option among others, or an INI file or scene by its name alone. With blanks a name
// is in quotation marks.
const std::regex& word() {
    static const std::regex shape(
        R"((^|\s)([+-](?:hi|rf|i|l)|(?:library_path|input_file_name|include_header|radiosity_file_name)=)?("/[^"]*"|'/[^']*'|/\S*))",
        std::regex::icase);
    return shape;
}

bool is_setting(std::string_view line) {
    const auto equals = line.find('=');
    return equals != std::string_view::npos &&
           line.substr(0, equals).find_first_of("+-/\"'") == std::string_view::npos;
}

}  // namespace

PackedPaths::PackedPaths(fs::path folder, const std::vector<fs::path>& folders,
                         const std::vector<fs::path>& files)
    : folder_(without_slash(folder.lexically_normal())), root_(folder_) {
    for (const fs::path& other : folders) root_ = common_part(root_, absolute(other));
    for (const fs::path& file : files) root_ = common_part(root_, absolute(file).parent_path());
}

fs::path PackedPaths::absolute(const fs::path& named) const {
    return without_slash((folder_ / named).lexically_normal());
}

std::string PackedPaths::name_of(const fs::path& named) const {
    const std::string below = absolute(named).lexically_relative(root_).generic_string();
    return below == "." ? std::string(top) : std::string(top) + '/' + below;
}

std::string PackedPaths::mapped_name(const std::string& name) const {
    const char mark = name.empty() ? '\0' : name.front();
    if (name.size() >= 2 && (mark == '"' || mark == '\'') && name.back() == mark)
        return mark + mapped_name(name.substr(1, name.size() - 2)) + mark;
    if (name.empty() || name.front() != '/' || is_povrays_own(name)) return name;
    return absolute(name).lexically_relative(folder_).generic_string();
}

std::string PackedPaths::mapped_line(std::string_view line) const {
    const std::string text(line);
    std::smatch match;
    if (is_setting(line)) {
        if (!std::regex_match(text, match, setting())) return text;
        return match[1].str() + mapped_name(match[2]) + match[3].str();
    }
    std::string out;
    auto from = text.cbegin();
    while (std::regex_search(from, text.cend(), match, word())) {
        out.append(match.prefix());
        out += match[1].str() + match[2].str() + mapped_name(match[3]);
        from = match.suffix().first;
    }
    out.append(from, text.cend());
    return out;
}

std::string PackedPaths::mapped_option(const std::string& option) const {
    return mapped_line(option);
}

std::string PackedPaths::mapped_ini(std::string_view text) const {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view line = text.substr(at, end - at);
        const std::size_t comment = std::min(line.find(';'), line.size());
        out += mapped_line(line.substr(0, comment));
        out += line.substr(comment);
        if (end < text.size()) out += '\n';
        at = end + 1;
    }
    return out;
}

}  // namespace mpipov
