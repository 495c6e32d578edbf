#include "serial_render.h"

#include "failure.h"
#include "image_source.h"
#include "launch_failure.h"
#include "povray_command.h"
#include "printable.h"
#include "run_child.h"
#include "worker.h"

#include <fmt/format.h>

#include <algorithm>

namespace mpipov {

namespace fs = std::filesystem;

namespace {

bool same_pixels(const fs::path& a, const fs::path& b) {
    constexpr int rows = 16;
    ImageSource p(a), q(b);
    ImageBand of_p, of_q;
    while (p.next_band(rows, of_p))
        if (!q.next_band(rows, of_q) || of_p.raw != of_q.raw) return false;
    return true;
}

void move_file(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::create_directories(to.parent_path(), error);
    fs::rename(from, to, error);
    if (!error) return;
    error.clear();
    fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);  // another file system
    if (error)
        throw Failure(Exit::file,
                      fmt::format("cannot write '{}': {}", to.string(), error.message()));
}

}  // namespace

SerialRenderer::SerialRenderer(std::string povray, const std::vector<std::string>& user_arguments,
                               fs::path scratch, const SceneRules& rules,
                               std::vector<fs::path> reads)
    : povray_(std::move(povray)),
      arguments_(quote_arguments(user_arguments)),
      scratch_(std::move(scratch)),
      reads_(std::move(reads)),
      confinement_(confinement_by(rules, povray_, user_arguments, scratch_)) {}

SerialRender SerialRenderer::render(const std::string& name, const std::vector<std::string>& more,
                                    const fs::path& folder, int threads) const {
    SerialRender render{name, {povray_}, {}, 0, 0, {}, {}};
    std::vector<std::string>& argv = render.argv;
    argv.insert(argv.end(), arguments_.begin(), arguments_.end());
    argv.insert(argv.end(), more.begin(), more.end());
    argv.push_back(fmt::format("+WT{}", threads));
    const fs::path place = scratch_ / ("serial-" + name);
    std::error_code error;
    fs::remove_all(place, error);
    fs::create_directories(place, error);

    LaunchNeeds needs{argv, place, {}, threads, {}, reads_};
    for (const char* quiet : {"-D", "-P", "-C", "+V", "Create_Ini=", "All_Console=on"})
        needs.argv.emplace_back(quiet);
    needs.argv.push_back(fmt::format("+O\"{}\"", (place / "image").string()));
    std::string output;
    const ChildResult result = run_child(confinement_.request(std::move(needs)), &output);
    if (result.exit_code == 127) throw Failure(Exit::scene, povray_not_found(povray_));
    if (result.exit_code != 0)
        throw Failure(is_option_error(output) ? Exit::usage : Exit::scene,
                      printable(describe_failure(result, output, confinement_)));
    render.wall_seconds = result.wall_seconds;
    render.cpu_seconds = result.cpu_seconds;
    render.report = parse_report(output);
    render.text = std::move(output);
    const fs::path image = find_image(place / "image");
    render.image = folder / (name + image.extension().string());
    move_file(image, render.image);
    fs::remove_all(place, error);
    return render;
}

NoiseRenders render_noise(const SerialRenderer& renderer, const SerialRender& reference,
                          const NoiseRequest& request) {
    NoiseRenders noise;
    const int most = 3 * request.wanted + variants_to_call_exact;
    while (static_cast<int>(noise.renders.size()) < request.wanted && noise.tried < most) {
        if (noise.tried == variants_to_call_exact && noise.renders.empty() &&
            !request.order_dependent) {
            noise.exact = true;
            break;
        }
        const NoiseVariant variant = noise_variant(noise.tried++, request.keep_blocks);
        SerialRender render = renderer.render(variant.name, variant.arguments, request.folder);
        const auto same = [&](const SerialRender& other) {
            return same_pixels(other.image, render.image);
        };
        if (same(reference) || std::any_of(noise.renders.begin(), noise.renders.end(), same)) {
            std::error_code ignored;
            fs::remove(render.image, ignored);
            continue;
        }
        if (request.told) request.told(variant.name);
        noise.renders.push_back(std::move(render));
    }
    return noise;
}

bool sees_blocks(const LaunchReport& report) {
    return report.antialiasing.on && report.antialiasing.method == 1;
}

}  // namespace mpipov
