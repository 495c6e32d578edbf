#include "refused_file.h"

#include "inside.h"
#include "povray_text.h"
#include "scene_folders.h"

#include <algorithm>
#include <array>
#include <system_error>
#include <vector>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

// What stands between the two, and nothing else but where in the scene before the first.
std::optional<std::string> between(std::string_view line, std::string_view before,
                                   std::string_view after) {
    const std::size_t begin = line.find(before);
    if (begin == std::string_view::npos) return {};
    // "File 'scene.pov' line 3: "; of what a scene prints "Parse Warning: " or the like is the
    // first of these.
    const std::string_view place = line.substr(0, begin);
    if (!place.empty() && (!place.starts_with("File '") || !place.ends_with(": ") ||
                           place.find("Warning:") != std::string_view::npos ||
                           place.find("Error:") != std::string_view::npos))
        return {};
    line.remove_prefix(begin + before.size());
    const std::size_t end = line.rfind(after);
    if (end == std::string_view::npos) return {};
    return std::string(line.substr(0, end));
}

}  // namespace

std::optional<RefusedFile> refused_file(std::string_view output) {
    const std::vector<std::string> lines = unwrap_lines(output);
    const auto is_error = [](const std::string& line) {
        return line.find("Error: ") != std::string::npos;
    };
    const auto last = std::find_if(lines.rbegin(), lines.rend(), is_error);
    if (last == lines.rend()) {
        // A text stream (+GA), before anything of the scene is read.
        for (const std::string& line : lines)
            if (auto name = between(line, "Cannot open file '", "' for output."))
                return RefusedFile{std::move(*name), true};
        return {};
    }
    for (const char* how : {" (write).", " (append)."})
        if (auto name = between(*last, "Parse Error: Cannot open user file ", how))
            return RefusedFile{std::move(*name), true};
    // It says which file before it says what for.
    if (!between(*last, "Parse Error: Cannot open ", "") &&
        !between(*last, "Parse Error: Cannot read ", "") &&
        !between(*last, "Possible Parse Error: Cannot ", ""))
        return {};
    for (auto line = last; line != lines.rend() && line - last < 2; ++line)
        if (auto name = between(*line, "Possible Parse Error: Cannot find file '",
                                "', even after trying to append file type extension."))
            return RefusedFile{std::move(*name), false};
    return {};
}

bool may_be_proposed(const fs::path& folder, const fs::path& home) {
    constexpr std::array systems{"boot", "dev", "etc", "lost+found", "proc",
                                 "root", "run", "sys", "usr",        "var"};
    constexpr std::string_view a_shells = "'\"\\`$!";
    const std::string text = folder.string();
    if (text.find_first_of(a_shells) != std::string::npos) return false;
    if (std::ranges::any_of(text, [](unsigned char c) { return c < ' ' || c == 0x7f; }))
        return false;
    if (is_for_more_than_a_scene(folder, home)) return false;
    for (const fs::path& part : folder)
        if (part.string().starts_with('.')) return false;
    std::error_code error;
    // The home folder of root is one of the system's.
    if (!home.empty() && lies_in(folder, fs::weakly_canonical(home, error))) return true;
    const fs::path below = folder.relative_path();
    return !below.empty() && std::ranges::find(systems, *below.begin()) == systems.end();
}

}  // namespace mpipov
