#include "compare.h"

#include "failure.h"
#include "image_stack.h"

#include <fmt/format.h>

#include <stdexcept>

namespace mpipov {

Comparison compare_images(const CompareRequest& request) {
    ImageStack images({request.a, request.b});
    const ImageShape shape = images.shape();

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
    images.for_each_row(
        [&](int y, std::span<const std::span<const double>> rows) {
            metrics.add_row(y, rows[0], rows[1]);
            if (profile) profile->add_row(y, rows[0], rows[1]);
        },
        request.rows_per_band);
    Comparison comparison{request.a,
                          request.b,
                          images.format(),
                          images.format(1).type,
                          request.peak,
                          metrics.result(),
                          {},
                          {}};
    if (profile) comparison.seams = profile->finish();
    return comparison;
}

}  // namespace mpipov
