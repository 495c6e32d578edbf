#include "serial_set.h"

#include "failure.h"
#include "job_identity.h"
#include "json_input.h"
#include "povray_command.h"
#include "probe.h"
#include "scratch.h"
#include "seam_judge.h"
#include "serial_manifest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

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

SerialRender as_render(const ListedRender& listed, const fs::path& folder) {
    SerialRender render;
    render.name = listed.name;
    render.argv = listed.argv;
    render.image = folder / listed.image;
    render.wall_seconds = listed.wall_seconds;
    render.cpu_seconds = listed.cpu_seconds;
    if (!fs::exists(render.image))
        throw std::runtime_error(fmt::format("'{}' is not there", render.image.string()));
    return render;
}

SerialManifest read_manifest(const fs::path& file) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error("there is no such file");
    return manifest_from_json(parse_json(in));
}

// What is not as `request` asks for, as far as it is said without asking POV-Ray; empty: nothing.
std::string mismatch(const SerialManifest& manifest, const SerialRequest& request) {
    if (manifest.arguments != request.arguments)
        return fmt::format("rendered with other arguments: {}", fmt::join(manifest.arguments, " "));
    if (manifest.wanted < request.renders)
        return fmt::format("only {} renders to tell noise by, not {}", manifest.wanted,
                           request.renders);
    if (request.one_block && manifest.method_1 && !manifest.references.contains("oneblock"))
        return "without the reference in one block";
    return {};
}

}  // namespace

bool is_exact(const NoiseReport& noise) {
    constexpr long long one_in = 1000;
    return noise.exact || (!noise.why_not.empty() && noise.floor &&
                           noise.floor->noisy * one_in <= noise.floor->samples);
}

SceneAsked ask_scene(const std::vector<std::string>& arguments, const std::string& povray,
                     const SceneRules& rules) {
    const ScratchFolder scratch("probe"), own("own");
    SceneAsked scene;
    scene.povray_version = povray_version(povray);
    const Confinement confinement = confinement_by(rules, povray, arguments, own.path());
    tell_note(confinement);
    const Probe probe =
        run_probe({povray, quote_arguments(arguments), scratch.path(), {}, {}, confinement});
    const ImageOptions& image = probe.result.image;
    scene.file = image.input_file;
    scene.name = fs::path(image.input_file).stem().string();
    scene.identity = job_identity(probe, arguments, scene.povray_version);
    scene.order_dependent = probe.result.order_dependent;
    for (const auto& [key, value] : probe.settings)
        if (key == "Library_Path") scene.library_paths.emplace_back(value);
    scene.longest_side = std::max(image.width, image.height);
    scene.pixels = static_cast<long long>(image.region.width()) * image.region.height();
    return scene;
}

SerialSet render_serial_set(const SerialRequest& request, const fs::path& folder) {
    const ScratchFolder scratch("serial");
    SerialSet set;
    set.scene = ask_scene(request.arguments, request.povray, request.rules);
    const SerialRenderer renderer(request.povray, request.arguments, scratch.path(), request.rules);
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
        const SerialManifest manifest = read_manifest(file);
        const auto require_none = [&](const std::string& wrong) {
            if (!wrong.empty())
                throw Failure(Exit::usage,
                              fmt::format("the serial renders in '{}' are {}: render them again "
                                          "with mpipov-validate noise --out",
                                          folder.string(), wrong));
        };
        require_none(mismatch(manifest, request));
        SerialSet set;
        for (const auto& [name, render] : manifest.references) {
            SerialRender& reference = set.references[name] = as_render(render, folder);
            reference.report.antialiasing.on = manifest.method_1;
        }
        set.noise.why_not = manifest.why_not;
        set.noise.exact = manifest.exact;
        set.noise.tried = manifest.tried;
        for (const ListedRender& render : manifest.renders)
            set.noise.renders.push_back({as_render(render, folder), {}});

        set.scene = ask_scene(request.arguments, request.povray, request.rules);
        const std::string what = what_changed(manifest.identity, set.scene.identity);
        require_none(what.empty() ? "" : fmt::format("of another state of the scene: {}", what));
        compare_noise(set, {});
        return set;
    } catch (const Failure&) {
        throw;
    } catch (const std::exception& error) {
        throw Failure(Exit::file,
                      fmt::format("cannot use '{}': {}: is it of mpipov-validate noise --out?",
                                  file.string(), plain_words(error.what())));
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
