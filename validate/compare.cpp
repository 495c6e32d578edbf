#include "compare.h"

#include "failure.h"
#include "interrupt.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

namespace mpipov {
namespace {

void require_same_format(const ImageSource& a, const ImageSource& b) {
    const ImageFormat& p = a.format();
    const ImageFormat& q = b.format();
    const auto fail = [&](const std::string& what, const std::string& of_a,
                          const std::string& of_b) {
        throw Failure(Exit::file,
                      fmt::format("cannot compare '{}' with '{}': {} differ, {} and {}",
                                  a.file().string(), b.file().string(), what, of_a, of_b));
    };
    if (p.width != q.width || p.height != q.height)
        fail("their sizes", fmt::format("{} x {}", p.width, p.height),
             fmt::format("{} x {}", q.width, q.height));
    if (p.channels != q.channels)
        fail("their channels", fmt::format("{}", fmt::join(p.channels, ",")),
             fmt::format("{}", fmt::join(q.channels, ",")));
    if (p.depth != q.depth) fail("their depths", p.depth, q.depth);
}

}  // namespace

Comparison compare_images(const CompareRequest& request) {
    ImageSource a(request.a), b(request.b);
    require_same_format(a, b);
    const ImageFormat& format = a.format();
    const ImageShape shape{format.width, format.height, format.channel_count(), format.alpha};

    std::optional<SeamProfileBuilder> profile;
    if (request.run) {
        try {
            profile.emplace(make_seam_layout(*request.run), shape);
        } catch (const std::exception& error) {
            throw Failure(Exit::file, fmt::format("the run record does not fit '{}': {}",
                                                  request.b.string(), error.what()));
        }
    }
    MetricsBuilder metrics(shape);
    ImageBand band_a, band_b;
    while (a.next_band(request.rows_per_band, band_a)) {
        throw_if_interrupted();
        b.next_band(request.rows_per_band, band_b);
        for (int r = 0; r < band_a.rows; ++r) {
            metrics.add_row(band_a.y + r, band_a.row(r), band_b.row(r));
            if (profile) profile->add_row(band_a.y + r, band_a.row(r), band_b.row(r));
        }
    }
    Comparison comparison{request.a,    request.b,        format, b.format().type,
                          request.peak, metrics.result(), {},     {}};
    if (profile) comparison.seams = profile->finish();
    return comparison;
}

}  // namespace mpipov
