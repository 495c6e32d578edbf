#include "probe.h"

#include "child_process.h"
#include "failure.h"
#include "file_text.h"
#include "launch_failure.h"
#include "letter_case.h"
#include "probe_launches.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace mpipov {
namespace {

std::string oiio_type(const std::string& povray_type) {
    static const std::array<std::pair<const char*, const char*>, 7> types{{{"PNG", "png"},
                                                                           {"EXR", "openexr"},
                                                                           {"HDR", "hdr"},
                                                                           {"JPEG", "jpeg"},
                                                                           {"Targa", "targa"},
                                                                           {"BMP", "bmp"},
                                                                           {"PPM", "pnm"}}};
    for (const auto& [printed, name] : types)
        if (povray_type == printed) return name;
    throw Failure(Exit::usage,
                  fmt::format("cannot write an image of type '{}': choose +FN, +FE, +FH, +FJ, +FT, "
                              "+FB or +FP",
                              povray_type));
}

void refuse_what_is_no_single_image(const ImageOptions& image) {
    if (image.to_standard_output)
        throw Failure(Exit::usage,
                      "cannot write the image to standard output: name a file with +O");
    if (image.output_file.empty())
        throw Failure(Exit::usage, "no output file is asked for (-F): leave it out");
    if (image.animation && image.frames != 1)
        throw Failure(Exit::usage, fmt::format("{} frames are asked for, and a run renders one: "
                                               "choose it with +SFn +EFn",
                                               image.frames));
    if (image.width < 1 || image.height < 1)
        throw Failure(Exit::usage,
                      fmt::format("an image of {} x {} pixels has no pixels: see +W, +H",
                                  image.width, image.height));
    const Rect whole{0, 0, image.width, image.height};
    if (image.region.empty() || intersect(image.region, whole) != image.region)
        throw Failure(
            Exit::usage,
            fmt::format("columns {} to {} and rows {} to {} are no part of {} x {} pixels: "
                        "see +SC, +EC, +SR, +ER",
                        image.region.x0 + 1, image.region.x1, image.region.y0 + 1, image.region.y1,
                        image.width, image.height));
}

bool same_pixels(const std::filesystem::path& a, const std::filesystem::path& b) {
    const PixelLayout layout = read_layout(a);
    const Rect whole{0, 0, layout.width, layout.height};
    SectionReader first(a, layout.width, layout.height, whole);
    SectionReader second(b, layout.width, layout.height, whole);
    for (;;) {
        const auto x = first.next();
        const auto y = second.next();
        if (!x || !y) return !x && !y;
        if (x->pixels != y->pixels) return false;
    }
}

bool is_on(const std::map<std::string, std::string>& settings, const char* key) {
    const auto found = settings.find(key);
    if (found == settings.end()) return false;
    const std::string value = lower(found->second);
    return value == "on" || value == "true" || value == "yes" || value == "1";
}

// The number that the settings give `key`, where they do.
int number_in(const std::map<std::string, std::string>& settings, const std::string& key,
              int fallback) {
    const auto found = settings.find(key);
    if (found == settings.end()) return fallback;
    int number = fallback;
    std::from_chars(found->second.data(), found->second.data() + found->second.size(), number);
    return std::max(0, number);
}

PixelLayout layout_of_sample(const std::filesystem::path& sample) {
    try {
        return read_layout(sample);
    } catch (const std::runtime_error& error) {  // POV-Ray damages 8-bit gray PPM, for one
        throw Failure(Exit::usage,
                      fmt::format("POV-Ray writes an image that cannot be read: {}", error.what()));
    }
}

// Throws where POV-Ray could not be started or is another than 3.7; `output` begins with its
// banner.
std::string checked_version(const std::string& povray, bool not_started, std::string_view output) {
    if (not_started)
        throw Failure(
            Exit::scene,
            fmt::format("cannot start '{}': is POV-Ray installed (Debian: apt-get install "
                        "povray), or named with --povray?",
                        povray));
    const auto version = parse_version(output);
    if (!version || version->rfind("3.7", 0) != 0)
        throw Failure(Exit::scene, fmt::format("'{}' is not POV-Ray 3.7 but '{}'", povray,
                                               version ? *version : parse_error(output)));
    return *version;
}

// The version of the POV-Ray that resolved the user's command.
std::string check_resolved(const ProbeLaunches& launches, const ProbeRequest& request) {
    const std::string_view text = launches.resolve_output();
    if (!launches.resolved() && is_option_error(text))  // POV-Ray does not say which one it is
        throw Failure(Exit::usage, fmt::format("POV-Ray: {}; it was given: {}", parse_error(text),
                                               fmt::join(request.user_arguments, " ")));
    if (!launches.started() && !request.confinement.way_out(text).empty())
        throw Failure(Exit::scene, describe_failure(text, request.confinement));
    std::string version = checked_version(request.povray, !launches.started(), text);
    if (!launches.resolved()) {
        const LaunchFailure failure = blame_full_disk({describe_failure(text, request.confinement)},
                                                      {request.scratch, frame_bytes(0, 0)});
        throw Failure(failure.code, failure.why);
    }
    return version;
}

Probe probe_once(const ProbeRequest& request) {
    ProbeLaunches launches(request);
    launches.render(small_view(request.user_arguments));
    launches.wait();

    Probe probe;
    ProbeResult& result = probe.result;
    probe.povray = check_resolved(launches, request);
    const auto image = parse_image_options(launches.resolve_output());
    if (!image) throw Failure(Exit::scene, "POV-Ray did not say how large the image is");
    result.image = *image;
    refuse_what_is_no_single_image(*image);
    probe.style.type = oiio_type(image->type);

    const bool refuses_to_be_small = launches.refused_by_the_scene();
    if (refuses_to_be_small) {
        launches.render(middle_view({image->width, image->height}));
        launches.wait();
    }
    probe.style.sample = launches.sample();
    result.report = parse_report(launches.render_output());
    result.plain = parse_report(launches.plain_output());
    probe.style.extension = std::filesystem::path(image->output_file).extension().string();
    probe.style.jpeg_quality = image->jpeg_quality;
    probe.style.rle = image->rle;

    const PixelLayout layout = layout_of_sample(probe.style.sample);
    result.probe_pixels = static_cast<long long>(layout.width) * layout.height;
    if (refuses_to_be_small)
        result.probe_pixels = middle_view({layout.width, layout.height}).area.area();
    result.stored = {image->width, image->height, layout.channels, probe.style.type,
                     std::string(to_string(layout.depth))};
    const std::string settings = text_of(launches.settings_file());
    const auto values = parse_ini(settings);
    result.user_block = number_in(values, "render_block_size", 0);
    result.quality = std::min(number_in(values, "quality", 9), 9);  // 10 and 11 are 9
    result.own_cache = is_on(values, "radiosity_from_file");
    result.writes_cache = is_on(values, "radiosity_to_file");
    probe.settings = ini_settings(settings);
    const bool diffused = image->dithering.find("diffusion") != std::string::npos;
    const auto orders = launches.in_several_orders();
    result.seen_whole = !refuses_to_be_small;
    result.order_dependent = diffused || result.report.radiosity ||
                             !std::all_of(orders.begin(), orders.end(), [&](const auto& other) {
                                 return same_pixels(orders.front(), other);
                             });
    if (result.seen_whole) probe.radiosity_cache = launches.radiosity_cache();
    probe.warnings = parse_warnings(launches.render_output());
    probe.cpu_seconds = launches.cpu_seconds();
    probe.launches = launches.count();
    return probe;
}

// What POV-Ray says when a machine is so busy that its own threads do not come up in time.
bool was_overloaded(const Failure& failure) {
    return std::string_view(failure.what()).find("waiting for worker thread startup") !=
           std::string_view::npos;
}

}  // namespace

Probe run_probe(const ProbeRequest& request) {
    constexpr int attempts = 3;
    for (int attempt = 1;; ++attempt) {
        ProbeRequest one = request;
        one.scratch = request.scratch / fmt::format("{}", attempt);
        try {
            return probe_once(one);
        } catch (const Failure& failure) {
            if (attempt == attempts || !was_overloaded(failure)) throw;
        }
    }
}

std::string povray_version(const std::string& povray) {
    std::string output;
    ChildRequest request;
    request.argv = {povray, "--version"};
    request.timeout_seconds = 30;
    const ChildResult result = run_to_end(request, &output);
    return checked_version(povray, result.exit_code == 127, output);
}

}  // namespace mpipov
