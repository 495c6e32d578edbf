#include "render_options.h"

#include "option_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace mpipov {

namespace fs = std::filesystem;

void pass_on_povray_arguments(CLI::App& app) {
    app.allow_extras();
    app.set_help_flag("--help", "this text");  // -h could be POV-Ray's
}

std::vector<std::string> povray_arguments(const CLI::App& app) {
    std::vector<std::string> arguments = app.remaining();
    for (const std::string& argument : arguments)
        if (argument.rfind("--", 0) == 0)
            throw Failure(Exit::usage, fmt::format("unknown option '{}': see mpipov-validate {} "
                                                   "--help",
                                                   argument, app.get_name()));
    if (arguments.empty())
        throw Failure(Exit::usage,
                      fmt::format("no scene: mpipov-validate {} SCENE.pov ...", app.get_name()));
    return arguments;
}

std::vector<std::string> split_list(const std::string& option, const std::string& text) {
    std::vector<std::string> pieces;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t to = std::min(text.find(',', from), text.size());
        pieces.push_back(text.substr(from, to - from));
        if (pieces.back().empty())
            throw Failure(Exit::usage, fmt::format("{}: '{}' is no list like a,b,c", option, text));
        from = to + 1;
    }
    return pieces;
}

std::vector<std::string> split_radiosity(const std::string& text, bool scales) {
    const std::vector<std::string> all = each_once(split_list("--radiosity", text));
    for (const std::string& piece : all) try {
            Options ignored;
            const std::size_t slash = scales ? piece.find('/') : std::string::npos;
            set_radiosity(ignored, piece.substr(0, slash));
            if (slash != std::string::npos)
                whole(piece.substr(slash + 1), 1, "a scale: a whole number from 1");
        } catch (const Failure& failure) {
            throw Failure(Exit::usage, fmt::format("--radiosity: {}", failure.what()));
        }
    return all;
}

std::vector<int> split_numbers(const std::string& option, const std::string& text) {
    std::vector<int> numbers;
    for (const std::string& piece : split_list(option, text)) {
        int value = 0;
        const char* end = piece.data() + piece.size();
        const auto parsed = std::from_chars(piece.data(), end, value);
        if (parsed.ec != std::errc() || parsed.ptr != end || value < 1)
            throw Failure(Exit::usage,
                          fmt::format("{}: '{}' is not a whole number from 1", option, piece));
        numbers.push_back(value);
    }
    return numbers;
}

fs::path make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (!fs::is_directory(folder))
        throw Failure(Exit::file, fmt::format("cannot make the folder '{}': {}", folder.string(),
                                              error ? error.message() : "a file is in the way"));
    return fs::absolute(folder).lexically_normal();
}

}  // namespace mpipov
