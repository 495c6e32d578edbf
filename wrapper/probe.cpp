#include "probe.h"

#include "child_process.h"
#include "failure.h"
#include "interrupt.h"
#include "worker.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iterator>
#include <regex>
#include <utility>

namespace mpipov {
namespace {

constexpr const char* stop_text = "mpipov has seen what it needs";
// The small render's longest side: large enough to meet what is in the picture, small enough to
// cost about half a percent of it.
constexpr int smallest_side = 32, largest_side = 128, side_ratio = 16;
// Small blocks, so that there are many whose order can differ.
constexpr int probe_block = 8;
// Measured with a jittered light whose soft shadow falls into one small corner, at 32x24 to 80x60:
// +RP2 and +RP4 change its pixels at every size, +RP1 and +RP5 at most, +RP3 at none.
constexpr std::array other_orders{2, 5};

struct Launch {
    std::filesystem::path folder;
    ChildProcess child;
    bool stopped = false;
};

// The number in +W640 or Width=640, for the small render's shape; POV-Ray itself is asked for the
// real one at the same time.
int side_from_arguments(const std::vector<std::string>& arguments, const std::string& letter,
                        const std::string& key, int fallback) {
    const std::regex shape(fmt::format(R"(^(?:[+-]{}|{}=)(\d+)$)", letter, key), std::regex::icase);
    int side = fallback;
    for (const std::string& argument : arguments) {
        std::smatch match;
        if (!std::regex_match(argument, match, shape)) continue;
        const std::string digits = match[1];
        int value = 0;
        if (std::from_chars(digits.data(), digits.data() + digits.size(), value).ec ==
                std::errc() &&
            value > 0)
            side = value;
    }
    return side;
}

ImageSize small_size(const std::vector<std::string>& arguments) {
    const int width = side_from_arguments(arguments, "W", "Width", 800);
    const int height = side_from_arguments(arguments, "H", "Height", 600);
    const int longest = std::max(width, height);
    const double scale =
        static_cast<double>(std::clamp(longest / side_ratio, smallest_side, largest_side)) /
        longest;
    return {std::max(2, static_cast<int>(width * scale)),
            std::max(2, static_cast<int>(height * scale))};
}

// POV-Ray breaks lines anywhere, so the text is looked for without its line feeds.
bool met_our_header(std::string_view text) {
    std::string joined(text);
    joined.erase(std::remove(joined.begin(), joined.end(), '\n'), joined.end());
    return joined.find(stop_text) != std::string::npos;
}

class ProbeLaunches {
  public:
    explicit ProbeLaunches(const ProbeRequest& request) : request_(request) {
        std::filesystem::create_directories(request.scratch);
        const std::filesystem::path header = request.scratch / "stop.inc";
        std::ofstream(header) << "#error \"" << stop_text << "\"\n";
        const ImageSize size = small_size(request.user_arguments);
        const std::vector<std::string> small = {fmt::format("+W{}", size.width),
                                                fmt::format("+H{}", size.height),
                                                "+SC0",
                                                "+EC1",
                                                "+SR0",
                                                "+ER1",
                                                fmt::format("+BS{}", probe_block),
                                                "Create_Ini="};
        start("resolve", {fmt::format("+HI\"{}\"", header.string()),
                          fmt::format("+GI\"{}\"", settings_file().string())});
        start("small", small);
        for (const int order : other_orders) {
            std::vector<std::string> other_order = small;
            other_order.push_back(fmt::format("+RP{}", order));
            start(fmt::format("order{}", order), other_order);
        }
    }

    // Until all have ended, or one has failed.
    void wait() {
        for (;;) {
            throw_if_interrupted();
            bool running = false;
            for (Launch& launch : launches_) {
                if (launch.child.poll()) continue;
                running = true;
                // The first one is of no more use once it has met our header.
                if (&launch == launches_.data() && !launch.stopped &&
                    met_our_header(launch.child.output())) {
                    launch.child.kill_now();
                    launch.stopped = true;
                }
            }
            if (!running) return;
            if (resolve().ended() && !resolved()) return;
            if (small().ended() && small().result().exit_code != 0 && resolve().ended()) return;
            sleep();
        }
    }

    ChildProcess& resolve() { return launches_[0].child; }
    ChildProcess& small() { return launches_[1].child; }
    bool resolved() { return met_our_header(resolve().output()); }
    std::filesystem::path settings_file() const { return request_.scratch / "settings.ini"; }

    std::filesystem::path sample() { return image_of(launches_[1]); }
    std::vector<std::filesystem::path> in_other_orders() {
        std::vector<std::filesystem::path> images;
        for (std::size_t i = 2; i < launches_.size(); ++i) images.push_back(image_of(launches_[i]));
        return images;
    }
    int count() const { return static_cast<int>(launches_.size()); }

    double cpu_seconds() const {
        double sum = 0;
        for (const Launch& launch : launches_)
            if (launch.child.ended()) sum += launch.child.result().cpu_seconds;
        return sum;
    }

  private:
    void start(const std::string& name, const std::vector<std::string>& more) {
        const std::filesystem::path folder = request_.scratch / name;
        std::filesystem::create_directory(folder);
        ChildRequest child;
        child.argv.push_back(request_.povray);
        for (const auto* list : {&request_.user_arguments, &more})
            child.argv.insert(child.argv.end(), list->begin(), list->end());
        for (const char* ours : {"-D", "-P", "-C", "+V", "+WT1", "All_Console=on"})
            child.argv.emplace_back(ours);
        // The first launch is asked for the user's own output file; it never comes to write one.
        if (name != "resolve")
            child.argv.push_back(fmt::format("+O\"{}\"", (folder / "probe").string()));
        child.timeout_seconds = request_.timeout_seconds;
        launches_.push_back({folder, ChildProcess::start(child)});
    }

    // What a launch rendered; it says why where it did not.
    static std::filesystem::path image_of(Launch& launch) {
        if (!launch.child.ended() || launch.child.result().exit_code != 0)
            throw Failure(Exit::scene,
                          launch.child.ended() && launch.child.result().timed_out
                              ? "POV-Ray did not end a small render in time (--timeout)"
                              : fmt::format("POV-Ray: {}", parse_error(launch.child.output())));
        return find_image(launch.folder / "probe");
    }

    void sleep() {
        std::vector<pollfd> fds;
        for (const Launch& launch : launches_) {
            fds.push_back({launch.child.output_fd(), POLLIN, 0});
            fds.push_back({launch.child.exit_fd(), POLLIN, 0});
        }
        ::poll(fds.data(), fds.size(), 50);
    }

    const ProbeRequest& request_;
    std::vector<Launch> launches_;
};

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

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

int block_size(const std::string& ini) {
    const auto settings = parse_ini(ini);
    const auto found = settings.find("render_block_size");
    if (found == settings.end()) return 0;
    int size = 0;
    std::from_chars(found->second.data(), found->second.data() + found->second.size(), size);
    return std::max(0, size);
}

}  // namespace

namespace {

PixelLayout layout_of_sample(const std::filesystem::path& sample) {
    try {
        return read_layout(sample);
    } catch (const std::runtime_error& error) {  // POV-Ray damages 8-bit gray PPM, for one
        throw Failure(Exit::usage,
                      fmt::format("POV-Ray writes an image that cannot be read: {}", error.what()));
    }
}

Probe probe_once(const ProbeRequest& request) {
    ProbeLaunches launches(request);
    launches.wait();

    if (!launches.resolved()) {
        const std::string_view text = launches.resolve().output();
        if (is_option_error(text))  // POV-Ray does not say which one it is
            throw Failure(Exit::usage,
                          fmt::format("POV-Ray: {}; it was given: {}", parse_error(text),
                                      fmt::join(request.user_arguments, " ")));
        throw Failure(Exit::scene, fmt::format("POV-Ray: {}", parse_error(text)));
    }
    Probe probe;
    ProbeResult& result = probe.result;
    const auto image = parse_image_options(launches.resolve().output());
    if (!image) throw Failure(Exit::scene, "POV-Ray did not say how large the image is");
    result.image = *image;
    refuse_what_is_no_single_image(*image);
    probe.style.type = oiio_type(image->type);

    probe.style.sample = launches.sample();
    result.report = parse_report(launches.small().output());
    probe.style.extension = std::filesystem::path(image->output_file).extension().string();
    probe.style.jpeg_quality = image->jpeg_quality;
    probe.style.rle = image->rle;

    const PixelLayout layout = layout_of_sample(probe.style.sample);
    result.probe_pixels = static_cast<long long>(layout.width) * layout.height;
    result.stored = {image->width, image->height, layout.channels, probe.style.type,
                     std::string(to_string(layout.depth))};
    const std::string settings = text_of(launches.settings_file());
    result.user_block = block_size(settings);
    probe.settings = ini_settings(settings);
    const bool diffused = image->dithering.find("diffusion") != std::string::npos;
    const auto others = launches.in_other_orders();
    result.order_dependent =
        diffused || !std::all_of(others.begin(), others.end(), [&](const auto& other) {
            return same_pixels(probe.style.sample, other);
        });
    probe.warnings = parse_warnings(launches.small().output());
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
    if (result.exit_code == 127)
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

}  // namespace mpipov
