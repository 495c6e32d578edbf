#include "serial_set.h"

#include "failure.h"
#include "job_identity.h"
#include "povray_command.h"
#include "probe.h"
#include "scratch.h"
#include "seam_judge.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

SceneAsked ask_scene(const SerialRequest& request) {
    const ScratchFolder scratch("probe");
    SceneAsked scene;
    scene.povray_version = povray_version(request.povray);
    const Probe probe =
        run_probe({request.povray, quote_arguments(request.arguments), scratch.path(), {}});
    const ImageOptions& image = probe.result.image;
    scene.file = image.input_file;
    scene.name = fs::path(image.input_file).stem().string();
    scene.identity = job_identity(probe, request.arguments, scene.povray_version);
    scene.order_dependent = probe.result.order_dependent;
    scene.longest_side = std::max(image.width, image.height);
    return scene;
}

std::string why_no_noise(const NoiseRenders& found) {
    if (found.exact)
        return fmt::format(
            "the scene does not depend on the order of rendering: {} serial renders in other "
            "orders are the serial render bit for bit",
            found.tried);
    if (static_cast<int>(found.renders.size()) < fewest_noise_renders)
        return fmt::format(
            "the scene depends on the order of rendering, but only {} of {} other orders gave "
            "another image: too few to measure noise (the image has few render blocks)",
            found.renders.size(), found.tried);
    return {};
}

SerialRender read_render(const json& j, const fs::path& folder) {
    SerialRender render;
    render.name = j.at("name").get<std::string>();
    render.argv = j.at("argv").get<std::vector<std::string>>();
    render.image = folder / j.at("image").get<std::string>();
    render.wall_seconds = j.at("seconds").get<double>();
    render.cpu_seconds = j.at("cpu_seconds").get<double>();
    if (!fs::exists(render.image))
        throw std::runtime_error(fmt::format("'{}' is not there", render.image.string()));
    return render;
}

json parse_file(const fs::path& file) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error("there is no such file");
    return json::parse(in);
}

// What is not as `request` asks for; empty where all is.
std::string mismatch(const json& j, const SerialRequest& request, const SceneAsked& scene) {
    const auto arguments = j.at("arguments").get<std::vector<std::string>>();
    if (arguments != request.arguments)
        return fmt::format("rendered with other arguments: {}", fmt::join(arguments, " "));
    const json& identity = j.at("identity");
    if (const std::string what = what_changed(identity, scene.identity); !what.empty())
        return fmt::format("of another state of the scene: {}", what);
    if (const int had = j.at("wanted").get<int>(); had < request.renders)
        return fmt::format("only {} renders to tell noise by, not {}", had, request.renders);
    if (request.one_block && j.at("method_1").get<bool>() &&
        !j.at("references").contains("oneblock"))
        return "without the reference in one block";
    return {};
}

}  // namespace

bool is_exact(const NoiseReport& noise) {
    constexpr long long one_in = 1000;
    return noise.exact || (!noise.why_not.empty() && noise.floor &&
                           noise.floor->noisy * one_in <= noise.floor->samples);
}

SerialSet render_serial_set(const SerialRequest& request, const fs::path& folder) {
    const ScratchFolder scratch("serial");
    SerialSet set;
    set.scene = ask_scene(request);
    const SerialRenderer renderer(request.povray, request.arguments, scratch.path());
    const auto add_reference = [&](const std::string& name, const std::vector<std::string>& more) {
        fmt::print(stderr, "rendering the serial reference: {}\n", name);
        set.references[name] = renderer.render("serial-" + name, more, folder);
    };
    add_reference("default", {});
    const bool method_1 = sees_blocks(set.reference().report);
    if (request.one_block && method_1)
        add_reference("oneblock", {fmt::format("+BS{}", set.scene.longest_side)});

    NoiseRequest wanted;
    wanted.wanted = request.renders;
    wanted.order_dependent = set.scene.order_dependent;
    wanted.keep_blocks = method_1;
    wanted.folder = folder / "noise";
    wanted.told = [](const std::string& name) { fmt::print(stderr, "rendered {}\n", name); };
    NoiseRenders found = render_noise(renderer, set.reference(), wanted);
    set.noise.why_not = why_no_noise(found);
    set.noise.exact = found.exact;
    set.noise.tried = found.tried;
    for (SerialRender& render : found.renders) set.noise.renders.push_back({std::move(render), {}});
    compare_noise(set, {});
    return set;
}

SerialSet read_serial_set(const SerialRequest& request, const fs::path& folder) {
    const fs::path file = folder / "noise.json";
    try {
        const json j = parse_file(file);
        SerialSet set;
        set.scene = ask_scene(request);
        if (const std::string wrong = mismatch(j, request, set.scene); !wrong.empty())
            throw Failure(Exit::usage,
                          fmt::format("the serial renders in '{}' are {}: render them again with "
                                      "mpipov-validate noise --out",
                                      folder.string(), wrong));
        for (const auto& [name, render] : j.at("references").items()) {
            SerialRender& reference = set.references[name] = read_render(render, folder);
            reference.report.antialiasing.on = j.at("method_1").get<bool>();
        }
        const json& noise = j.at("noise");
        set.noise.why_not = noise.value("why_not", noise.value("why_not_enough", ""));
        set.noise.exact = j.at("exact").get<bool>();
        set.noise.tried = noise.at("tried").get<int>();
        for (const json& render : noise.value("renders", json::array()))
            set.noise.renders.push_back({read_render(render, folder), {}});
        compare_noise(set, {});
        return set;
    } catch (const Failure&) {
        throw;
    } catch (const std::exception& error) {
        throw Failure(Exit::file,
                      fmt::format("cannot use '{}': {}: is it of mpipov-validate noise --out?",
                                  file.string(), error.what()));
    }
}

void compare_noise(SerialSet& set, const std::optional<RunRecord>& run) {
    NoiseReport& noise = set.noise;
    if (noise.renders.empty()) return;
    const fs::path& reference = set.reference().image;
    std::vector<fs::path> files{reference};
    for (NoiseRender& render : noise.renders) {
        files.push_back(render.render.image);
        render.comparison = compare_images({reference, render.render.image, run});
    }
    if (!noise.floor) noise.floor = measure_noise(files);  // where seams lie says nothing to it
}

}  // namespace mpipov
