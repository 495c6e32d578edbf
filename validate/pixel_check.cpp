#include "pixel_check.h"

#include <algorithm>
#include <cmath>

namespace mpipov {
namespace {

double two_sided(double p, int renders) {
    return t_quantile(p / 2, renders - 1);
}

}  // namespace

PixelCalibration::PixelCalibration(int renders, const Rect& region, int channels)
    : region_(region),
      channels_(static_cast<std::size_t>(channels)),
      tails_(static_cast<std::size_t>(renders)) {}

void PixelCalibration::add(const ScoreRow& row) {
    if (row.y < region_.y0 || row.y >= region_.y1) return;
    TailSample& tail = tails_[static_cast<std::size_t>(row.render)];
    const auto first = static_cast<std::size_t>(region_.x0) * channels_;
    const auto last = static_cast<std::size_t>(region_.x1) * channels_;
    for (std::size_t i = first; i < last; ++i)
        if (!std::isnan(row.z[i])) tail.add(row.z[i]);
}

long long PixelCalibration::samples() const {
    return tails_.empty() ? 0 : tails_.front().count();
}

double PixelCalibration::critical(int combined) const {
    TailSample quiet;
    for (const TailSample& tail : tails_) quiet.add(tail);
    const double p = sidak(significance, static_cast<double>(samples()) * combined);
    return critical_value(quiet, p, two_sided(p, renders()));
}

std::vector<bool> PixelCalibration::alarms() const {
    std::vector<bool> alarms;
    const double p = sidak(significance, static_cast<double>(samples()));
    for (const TailSample& judged : tails_) {
        TailSample quiet;
        for (const TailSample& other : tails_)
            if (&other != &judged) quiet.add(other);
        const auto scores = judged.largest();
        alarms.push_back(!scores.empty() &&
                         scores.front() > critical_value(quiet, p, two_sided(p, renders() - 1)));
    }
    return alarms;
}

PixelTestBuilder::PixelTestBuilder(const SeamLayout& layout, const PixelCalibration& calibration,
                                   int channels, int combined)
    : layout_(&layout), distance_(layout), channels_(static_cast<std::size_t>(channels)) {
    test_.renders = calibration.renders();
    test_.alpha_sidak = sidak(significance, static_cast<double>(calibration.samples()) * combined);
    test_.critical = calibration.critical(combined);
}

void PixelTestBuilder::add_beyond(int x, int y, int distance) {
    Rect& box = test_.beyond_box;
    box = test_.beyond++ == 0 ? Rect{x, y, x + 1, y + 1}
                              : Rect{std::min(box.x0, x), std::min(box.y0, y),
                                     std::max(box.x1, x + 1), std::max(box.y1, y + 1)};
    if (distance >= 0 && distance <= PixelTest::near) ++test_.beyond_near;
    for (const Section& section : layout_->sections)
        if (section.keep.contains(x, y)) ++test_.beyond_by_section[section.id];
}

void PixelTestBuilder::add(const ScoreRow& row) {
    const Rect& region = layout_->region;
    if (row.y < region.y0 || row.y >= region.y1) return;
    const auto near = distance_.row(row.y);
    for (int x = region.x0; x < region.x1; ++x)
        for (std::size_t c = 0; c < channels_; ++c) {
            const std::size_t i = static_cast<std::size_t>(x) * channels_ + c;
            const double z = row.z[i];
            if (std::isnan(z)) continue;
            ++test_.samples;
            const NearSeam& seam = near[static_cast<std::size_t>(x)];
            const int distance = seam.seam < 0 ? -1 : seam.distance;
            if (!test_.largest || z > *test_.largest) {
                test_.largest = z;
                test_.at = PixelOutlier{x,
                                        row.y,
                                        static_cast<int>(c),
                                        row.value[i],
                                        row.expected[i],
                                        row.sigma[i],
                                        distance};
            }
            if (z > test_.critical) add_beyond(x, row.y, distance);
        }
}

}  // namespace mpipov
