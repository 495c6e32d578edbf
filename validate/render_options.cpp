#include "render_options.h"

#include "povray_command.h"
#include "probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>

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

SceneAsked ask_scene(const std::string& povray, const std::vector<std::string>& arguments,
                     const fs::path& scratch) {
    SceneAsked scene;
    scene.povray_version = povray_version(povray);
    const Probe probe = run_probe({povray, quote_arguments(arguments), scratch / "probe", {}});
    const ImageOptions& image = probe.result.image;
    scene.file = image.input_file;
    scene.name = fs::path(image.input_file).stem().string();
    scene.order_dependent = probe.result.order_dependent;
    scene.longest_side = std::max(image.width, image.height);
    return scene;
}

fs::path make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (!fs::is_directory(folder))
        throw Failure(Exit::file, fmt::format("cannot make the folder '{}': {}", folder.string(),
                                              error ? error.message() : "a file is in the way"));
    return fs::absolute(folder).lexically_normal();
}

NoiseReport find_noise(const NoiseSource& source) {
    NoiseRequest request;
    request.wanted = source.wanted;
    request.order_dependent = source.order_dependent;
    request.keep_blocks = sees_blocks(source.reference.report);
    request.folder = source.folder;
    request.told = [](const std::string& name) { fmt::print(stderr, "rendered {}\n", name); };
    NoiseRenders found = render_noise(source.renderer, source.reference, request);
    NoiseReport noise;
    noise.exact = found.exact;
    noise.tried = found.tried;
    for (SerialRender& render : found.renders) noise.renders.push_back({std::move(render), {}});
    if (found.exact)
        noise.why_not = fmt::format(
            "the scene does not depend on the order of rendering: {} serial renders in other "
            "orders are the serial render bit for bit",
            found.tried);
    else if (static_cast<int>(noise.renders.size()) < fewest_noise_renders)
        noise.why_not = fmt::format(
            "the scene depends on the order of rendering, but only {} of {} other orders gave "
            "another image: too few to measure noise (the image has few render blocks)",
            noise.renders.size(), found.tried);
    return noise;
}

void compare_noise(NoiseReport& noise, const SerialRender& reference,
                   const std::optional<RunRecord>& run) {
    if (noise.renders.empty()) return;
    std::vector<fs::path> files{reference.image};
    for (NoiseRender& render : noise.renders) {
        files.push_back(render.render.image);
        render.comparison = compare_images({reference.image, render.render.image, run});
    }
    if (!noise.floor) noise.floor = measure_noise(files);  // where seams lie says nothing to it
}

}  // namespace mpipov
