#include "tradeoff_truth.h"

#include "failure.h"
#include "image_source.h"
#include "interrupt.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

constexpr std::array<int, 2> factors{8, 10};

// That POV-Ray takes of one pixel: the middle one, and n x n where there is antialiasing.
int samples_at(int depth) {
    return depth == 1 ? 1 : depth * depth + 1;
}

// POV-Ray's bounds are 1-based and inclusive. None where all is rendered.
std::vector<std::string> region_arguments(const TruthRequest& request, int k) {
    const Rect& region = request.region;
    if (region == Rect{0, 0, request.width, request.height}) return {};
    return {fmt::format("+SC{}", k * region.x0 + 1), fmt::format("+EC{}", k * region.x1),
            fmt::format("+SR{}", k * region.y0 + 1), fmt::format("+ER{}", k * region.y1)};
}

std::vector<std::string> large_render(const TruthRequest& request, int factor, bool other_order) {
    std::vector<std::string> arguments{"+FE", "-UA", fmt::format("+W{}", request.width * factor),
                                       fmt::format("+H{}", request.height * factor)};
    const auto add = [&](const std::vector<std::string>& more) {
        arguments.insert(arguments.end(), more.begin(), more.end());
    };
    if (request.depth == 1)
        add({"-A"});
    else
        add({"+A0.0", "+AM1", fmt::format("+R{}", request.depth), "-J"});
    add(region_arguments(request, factor));
    if (other_order) add({"+RP1", "+BS24"});
    return arguments;
}

struct Averages {
    Supersampled wanted, other;
};

Averages average(const fs::path& file, const TruthRequest& request, int factor) {
    constexpr int rows = 64;
    const Rect& region = request.region;
    const auto sampler = [&](Averaging averaging) {
        return Supersampler(region.width(), region.height(), factor, averaging);
    };
    Supersampler wanted = sampler(request.averaging),
                 other = sampler(request.averaging == Averaging::linear ? Averaging::encoded
                                                                        : Averaging::linear);
    ImageSource source(file);
    const auto channels = static_cast<std::size_t>(source.format().channel_count());
    const int width = request.width * factor, height = request.height * factor;
    if (channels < 3 || source.format().width != width || source.format().height != height)
        throw Failure(Exit::scene,
                      fmt::format("POV-Ray rendered {} x {} pixels where {} x {} were "
                                  "asked for: the truth cannot be made",
                                  source.format().width, source.format().height, width, height));
    const int first = region.y0 * factor, last = region.y1 * factor;
    const auto left = static_cast<std::size_t>(region.x0 * factor);
    const auto wide = static_cast<std::size_t>(region.width() * factor);
    std::vector<double> samples(wide * 3);
    ImageBand band;
    while (source.next_band(rows, band)) {
        throw_if_interrupted();
        for (int r = 0; r < band.rows; ++r) {
            const int y = band.y + r;
            if (y < first || y >= last) continue;
            const std::span<const double> row = band.row(r);
            for (std::size_t x = 0; x < wide; ++x)
                for (std::size_t c = 0; c < 3; ++c)
                    samples[x * 3 + c] = row[(left + x) * channels + c];
            wanted.add_row(y - first, samples);
            other.add_row(y - first, samples);
        }
    }
    return {wanted.result(), other.result()};
}

void write_picture(const fs::path& file, const Supersampled& picture, const TruthRequest& request) {
    constexpr double full_scale = 65535;
    const std::vector<double> values = picture.encoded();
    std::vector<std::uint16_t> pixels(static_cast<std::size_t>(request.width) *
                                      static_cast<std::size_t>(request.height) * 3);
    const auto of_row = static_cast<std::size_t>(picture.width) * 3;
    for (int y = 0; y < picture.height; ++y) {
        const std::size_t to = (static_cast<std::size_t>(y + request.region.y0) *
                                    static_cast<std::size_t>(request.width) +
                                static_cast<std::size_t>(request.region.x0)) *
                               3;
        for (std::size_t i = 0; i < of_row; ++i)
            pixels[to + i] = static_cast<std::uint16_t>(
                std::lround(values[static_cast<std::size_t>(y) * of_row + i] * full_scale));
    }
    write_colour_image(file, request.width, request.height, pixels);
}

}  // namespace

int truth_samples(int depth) {
    int samples = 0;
    for (const int factor : factors) samples += factor * factor;
    return samples * samples_at(depth);
}

int Truth::samples() const {
    return truth_samples(depth);
}

double Truth::error() const {
    return std::hypot(sampling_error, rounding_error);
}

Truth render_truth(const SerialRenderer& renderer, const TruthRequest& request,
                   const fs::path& scratch, const fs::path& folder) {
    Truth truth;
    truth.depth = request.depth;
    std::vector<Averages> found;
    for (const int factor : factors) {
        const bool other_order = request.order_dependent && !found.empty();
        const SerialRender render =
            renderer.render("samples", large_render(request, factor, other_order), scratch,
                            request.order_dependent ? 1 : request.threads);
        truth.argv.push_back(render.argv);
        truth.wall_seconds += render.wall_seconds;
        truth.cpu_seconds += render.cpu_seconds;
        found.push_back(average(render.image, request, factor));
        std::error_code ignored;
        fs::remove(render.image, ignored);
    }
    const Combined wanted = combine(found[0].wanted, found[1].wanted);
    truth.sampling_error = wanted.sampling_error;
    truth.rounding_error = wanted.rounding_error;
    truth.image = folder / "truth.png";
    truth.other = folder / "truth-other.png";
    write_picture(truth.image, wanted.picture, request);
    write_picture(truth.other, combine(found[0].other, found[1].other).picture, request);
    return truth;
}

int next_depth(int depth, double error, double wanted, int most) {
    if (most <= depth) return depth;
    for (int next = depth + 1; next < most; ++next)
        if (error * std::sqrt(static_cast<double>(truth_samples(depth)) / truth_samples(next)) <=
            wanted)
            return next;
    return most;
}

int deepest_within(int samples, double seconds, const Truth& known) {
    int deepest = 0;
    for (int depth = 1; depth <= deepest_truth; ++depth)
        if (truth_samples(depth) <= samples &&
            known.wall_seconds * truth_samples(depth) <= seconds * known.samples())
            deepest = depth;
    return deepest;
}

}  // namespace mpipov
