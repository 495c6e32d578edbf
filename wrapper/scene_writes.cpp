#include "scene_writes.h"

#include "file_text.h"
#include "interrupt.h"
#include "scene_files.h"
#include "scene_folders.h"

#include <algorithm>
#include <iterator>
#include <regex>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

// Includes are far shorter, and a scan of a mesh is not worth its time.
constexpr std::uintmax_t most_scanned_bytes = std::uintmax_t{16} << 20;
constexpr std::uintmax_t most_copied_bytes = std::uintmax_t{64} << 20;
// Of a file, and of all, that a scene may or may not write to: what it keeps notes in is small.
constexpr std::uintmax_t most_guessed_bytes = std::uintmax_t{1} << 20;
constexpr std::uintmax_t most_guessed_in_all = std::uintmax_t{16} << 20;
constexpr int most_guessed_files = 200;
// Between the directive and its last word.
constexpr std::size_t longest_name = 400;

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

std::string_view without_blanks(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    return text;
}

// HANDLE "name" write: the name, where it is a literal.
void take_directive(std::string_view text, SceneWrites& writes) {
    text = text.substr(0, std::min(text.find('#'), longest_name));
    static const std::regex shape(
        R"re(^\s*\w+\s+(?:"([^"]*)"|([^"][\s\S]*?))\s*\b(write|append)\b)re");
    std::match_results<std::string_view::const_iterator> match;
    if (!std::regex_search(text.begin(), text.end(), match, shape)) return;
    writes.any = true;
    if (match[1].matched)
        writes.names.push_back(match[1].str());
    else
        writes.computed = true;
}

}  // namespace

SceneWrites writes_in(std::string_view text) {
    SceneWrites writes;
    for (std::size_t at = text.find('#'); at != std::string_view::npos; at = text.find('#', at)) {
        const std::string_view behind = without_blanks(text.substr(++at));
        constexpr std::string_view word = "fopen";
        if (behind.substr(0, word.size()) == word)
            take_directive(behind.substr(word.size()), writes);
    }
    return writes;
}

namespace {

void take_file(const fs::path& file, SceneWrites& all) {
    std::error_code error;
    if (fs::file_size(file, error) > most_scanned_bytes || error) return;
    SceneWrites one = writes_in(text_of(file));
    all.any = all.any || one.any;
    all.computed = all.computed || one.computed;
    std::move(one.names.begin(), one.names.end(), std::back_inserter(all.names));
}

}  // namespace

SceneWrites writes_of_scene(const std::vector<std::string>& arguments,
                            const std::vector<fs::path>& library_paths) {
    SceneWrites all;
    for (const fs::path& file : scene_files({{}, arguments, library_paths, {}}))
        take_file(file, all);
    return all;
}

SceneWrites writes_in_folder(const fs::path& folder) {
    SceneWrites all;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) take_file(entry.path(), all);
    return all;
}

namespace {

// Links in `at` to all that lies in `original` but `way`.
void link_all_but(const fs::path& at, const fs::path& original, const fs::path& way) {
    constexpr int most_links = 4096;
    std::error_code error;
    std::vector<fs::path> names;
    for (fs::directory_iterator entry(original, error), end; !error && entry != end;
         entry.increment(error)) {
        if (names.size() >= most_links) return;
        if (entry->path().filename() != way) names.push_back(entry->path().filename());
    }
    for (const fs::path& name : names) fs::create_symlink(original / name, at / name, error);
}

// Which files of a folder a scene gets copies of.
class Copies {
  public:
    Copies(const fs::path& original, const SceneWrites& written,
           const std::vector<fs::path>& readable)
        : written_(written), readable_(readable), all_readable_(may_be_read(original, readable)) {}

    // What costs least is asked first: there may be very many files.
    bool takes(const fs::directory_entry& entry) {
        const bool named = std::ranges::find(written_.names, entry.path().filename().string()) !=
                           written_.names.end();
        if (!named && (!written_.computed || guessed_files_ >= most_guessed_files)) return false;
        std::error_code error;
        // Not what a link leads to: that may be out of the scene's reach.
        if (entry.symlink_status(error).type() != fs::file_type::regular) return false;
        const std::uintmax_t bytes = entry.file_size(error);
        if (error || bytes > (named ? most_copied_bytes : most_guessed_bytes)) return false;
        if (!named && guessed_bytes_ + bytes > most_guessed_in_all) return false;
        if (!all_readable_ && !may_be_read(entry.path(), readable_)) return false;
        if (named) return true;
        guessed_bytes_ += bytes;
        ++guessed_files_;
        return true;
    }

  private:
    const SceneWrites& written_;
    const std::vector<fs::path>& readable_;
    bool all_readable_;
    std::uintmax_t guessed_bytes_ = 0;
    int guessed_files_ = 0;
};

}  // namespace

fs::path make_writable_view(const fs::path& folder, const fs::path& original,
                            const SceneWrites& written, const std::vector<fs::path>& readable) {
    fs::path at = folder, seen = "/";
    fs::create_directory(at);
    for (const fs::path& way : fs::canonical(original).relative_path()) {
        link_all_but(at, seen, way);
        at /= way;
        seen /= way;
        fs::create_directory(at);
    }
    Copies copies(original, written, readable);
    std::error_code error;  // of a folder that may not be listed POV-Ray sees nothing either
    for (fs::directory_iterator entry(original, error), end; !error && entry != end;
         entry.increment(error)) {
        throw_if_interrupted();  // there may be very many
        const fs::path name = entry->path().filename();
        std::error_code ignored;
        if (copies.takes(*entry))
            fs::copy_file(entry->path(), at / name, ignored);
        else
            fs::create_symlink(entry->path(), at / name, ignored);
    }
    return at;
}

}  // namespace mpipov
