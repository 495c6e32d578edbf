#include "tradeoff_truth.h"

#include "failure.h"
#include "image_source.h"
#include "interrupt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

// POV-Ray's bounds are 1-based and inclusive. None where all is rendered.
std::vector<std::string> region_arguments(const TruthRequest& request) {
    const Rect& region = request.region;
    if (region == Rect{0, 0, request.width, request.height}) return {};
    const int k = request.factor;
    return {fmt::format("+SC{}", k * region.x0 + 1), fmt::format("+EC{}", k * region.x1),
            fmt::format("+SR{}", k * region.y0 + 1), fmt::format("+ER{}", k * region.y1)};
}

struct Averages {
    Supersampled wanted, other;
};

Averages average(const fs::path& file, const TruthRequest& request) {
    constexpr int rows = 64;
    const Rect& region = request.region;
    const auto sampler = [&](Averaging averaging) {
        return Supersampler(region.width(), region.height(), request.factor, averaging);
    };
    Supersampler wanted = sampler(request.averaging),
                 other = sampler(request.averaging == Averaging::linear ? Averaging::encoded
                                                                        : Averaging::linear);
    ImageSource source(file);
    const auto channels = static_cast<std::size_t>(source.format().channel_count());
    if (channels < 3 || source.format().width != request.width * request.factor ||
        source.format().height != request.height * request.factor)
        throw Failure(Exit::scene,
                      fmt::format("POV-Ray rendered {} x {} pixels where {} x {} were asked for: "
                                  "the truth cannot be made",
                                  source.format().width, source.format().height,
                                  request.width * request.factor, request.height * request.factor));
    const int first = region.y0 * request.factor, last = region.y1 * request.factor;
    const auto left = static_cast<std::size_t>(region.x0 * request.factor);
    const auto wide = static_cast<std::size_t>(region.width() * request.factor);
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
                std::lround(picture.pixels[static_cast<std::size_t>(y) * of_row + i] * full_scale));
    }
    write_colour_image(file, request.width, request.height, pixels);
}

}  // namespace

double Truth::error() const {
    return std::hypot(std::max(sampling_error, order_error), rounding_error);
}

Truth render_truth(const SerialRenderer& renderer, const TruthRequest& request,
                   const fs::path& scratch, const fs::path& folder) {
    Truth truth;
    truth.factor = request.factor;
    std::vector<Averages> found;
    const std::vector<std::vector<std::string>> orders =
        request.order_dependent ? std::vector<std::vector<std::string>>{{}, {"+RP1", "+BS24"}}
                                : std::vector<std::vector<std::string>>{{}};
    for (const std::vector<std::string>& order : orders) {
        std::vector<std::string> more{"-A", "+FE", "-UA",
                                      fmt::format("+W{}", request.width * request.factor),
                                      fmt::format("+H{}", request.height * request.factor)};
        const std::vector<std::string> region = region_arguments(request);
        more.insert(more.end(), region.begin(), region.end());
        more.insert(more.end(), order.begin(), order.end());
        const SerialRender render = renderer.render("samples", more, scratch,
                                                    request.order_dependent ? 1 : request.threads);
        truth.argv.push_back(render.argv);
        truth.wall_seconds += render.wall_seconds;
        truth.cpu_seconds += render.cpu_seconds;
        ++truth.renders;
        found.push_back(average(render.image, request));
        std::error_code ignored;
        fs::remove(render.image, ignored);
    }
    const auto all = [&](Supersampled Averages::*which) {
        return found.size() > 1 ? combine(found[0].*which, found[1].*which)
                                : Combined{found[0].*which, 0};
    };
    const Combined wanted = all(&Averages::wanted);
    truth.sampling_error = wanted.picture.sampling_error;
    truth.rounding_error = wanted.picture.rounding_error;
    truth.order_error = wanted.order_error;
    truth.image = folder / "truth.png";
    truth.other = folder / "truth-other.png";
    write_picture(truth.image, wanted.picture, request);
    write_picture(truth.other, all(&Averages::other).picture, request);
    return truth;
}

int next_factor(int factor, double error, double wanted, int most) {
    const double needed = wanted > 0 ? factor * error / wanted : most;
    int next = needed < most ? static_cast<int>(std::ceil(needed)) : most;
    next += next % 2;
    return std::min(std::max(next, factor + 2), most - most % 2);
}

}  // namespace mpipov
