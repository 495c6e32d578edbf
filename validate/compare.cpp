#include "compare.h"

#include "failure.h"
#include "image_stack.h"
#include "interrupt.h"

#include <fmt/format.h>

#include <stdexcept>

namespace mpipov {
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
