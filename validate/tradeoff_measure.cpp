#include "tradeoff_measure.h"

#include "compare.h"
#include "failure.h"

#include <algorithm>
#include <cmath>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

constexpr double levels = 255;

bool whole(const TradeoffReport& report) {
    return report.image && report.region == Rect{0, 0, report.image->width, report.image->height};
}

}  // namespace

TradeoffError error_of(const TradeoffReport& report, const fs::path& reference,
                       const fs::path& image) {
    const Comparison compared = compare_images({reference, image, {}});
    const double scale = levels / compared.format.full_scale();
    // Outside of the region both are black.
    const double all = static_cast<double>(compared.format.width) * compared.format.height;
    const double inside = static_cast<double>(report.region.width()) * report.region.height();
    TradeoffError error;
    error.rms = scale * compared.metrics.all.rms().value_or(0) * std::sqrt(all / inside);
    error.largest = scale * compared.metrics.all.max().value_or(0);
    error.identical = compared.identical();
    return error;
}

void add_errors(TradeoffReport& report) {
    const auto image_of = [&](const std::string& name) {
        const auto found =
            std::find_if(report.rows.begin(), report.rows.end(),
                         [&](const TradeoffRow& row) { return row.setting.name == name; });
        return found != report.rows.end() && found->measured() ? found->image : fs::path();
    };
    for (TradeoffRow& row : report.rows) {
        if (!row.measured()) continue;
        if (report.truth) row.truth = error_of(report, report.truth->image, row.image);
        const fs::path serial = image_of(row.setting.serial);
        if (!serial.empty()) row.serial = error_of(report, serial, row.image);
    }
}

void add_ssim(TradeoffReport& report) {
    std::vector<SsimPair> pairs;
    std::vector<TradeoffError*> wanted;
    const auto want = [&](std::optional<TradeoffError>& error, const fs::path& a,
                          const fs::path& b) {
        if (!error) return;
        if (error->identical) {
            error->ssim = ssim_of_identical();
        } else if (!whole(report)) {
            error->ssim.reason = "only a part of the image was rendered";
        } else {
            pairs.push_back({a, b, {}});
            wanted.push_back(&*error);
        }
    };
    for (TradeoffRow& row : report.rows) {
        if (report.truth) want(row.truth, report.truth->image, row.image);
        for (const TradeoffRow& other : report.rows)
            if (other.setting.name == row.setting.serial) want(row.serial, other.image, row.image);
    }
    try {
        const std::vector<Ssim> found = compute_ssim(pairs, 1);
        for (std::size_t i = 0; i < found.size(); ++i) wanted[i]->ssim = found[i];
    } catch (const Failure& failure) {
        if (failure.code() == Exit::interrupted) throw;
        for (TradeoffError* error : wanted) error->ssim.reason = failure.what();
    }
}

}  // namespace mpipov
