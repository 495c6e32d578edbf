#include "seam_step.h"

#include <algorithm>
#include <cmath>

namespace mpipov {

void StepBuilder::Side::add(double error) {
    if (!std::isfinite(error)) return;
    sum += error;
    ++count;
}

StepBuilder::StepBuilder(const Seam& line, const Rect& before, const Rect& after,
                         const ImageShape& shape)
    : line_(line), shape_(shape), channels_(static_cast<std::size_t>(shape.channels)) {
    first_ = std::max(line.position - window, line.vertical ? before.x0 : before.y0);
    last_ = std::min(line.position + window, line.vertical ? after.x1 : after.y1);
}

void StepBuilder::add_place(std::size_t channel, const Side& before, const Side& after) {
    if (before.count == 0 || after.count == 0) return;
    const double step = before.sum / before.count - after.sum / after.count;
    ChannelSums& sums = channels_[channel];
    sums.step.add(step);
    sums.magnitude.add(std::abs(step));
    ++sums.places;
}

void StepBuilder::add_row(int y, std::span<const double> a, std::span<const double> b) {
    if (line_.vertical) {
        if (y >= line_.from && y < line_.to) add_across(a, b);
    } else if (y >= first_ && y < last_) {
        add_along(y, a, b);
    }
}

void StepBuilder::add_across(std::span<const double> a, std::span<const double> b) {
    const std::size_t channels = channels_.size();
    for (std::size_t c = 0; c < channels; ++c) {
        Side before, after;
        for (int x = first_; x < last_; ++x) {
            const std::size_t i = static_cast<std::size_t>(x) * channels + c;
            (x < line_.position ? before : after).add(b[i] - a[i]);
        }
        add_place(c, before, after);
    }
}

void StepBuilder::add_along(int y, std::span<const double> a, std::span<const double> b) {
    const std::size_t channels = channels_.size();
    const auto length = static_cast<std::size_t>(line_.to - line_.from) * channels;
    const auto start = static_cast<std::size_t>(line_.from) * channels;
    if (y == first_) {
        before_.assign(length, {});
        after_.assign(length, {});
    }
    std::vector<Side>& side = y < line_.position ? before_ : after_;
    for (std::size_t i = 0; i < length; ++i) side[i].add(b[start + i] - a[start + i]);
    if (y + 1 != last_) return;
    for (std::size_t i = 0; i < length; ++i) add_place(i % channels, before_[i], after_[i]);
    before_ = {};
    after_ = {};
}

LineStep StepBuilder::result() const {
    LineStep result{line_, {}, {}, {}};
    Sum steps, magnitudes;
    int colours = 0;
    for (int c = 0; c < shape_.channels; ++c) {
        const ChannelSums& sums = channels_[static_cast<std::size_t>(c)];
        if (sums.places == 0) {
            result.channels.emplace_back();
            continue;
        }
        const auto places = static_cast<double>(sums.places);
        const double step = sums.step.value() / places;
        result.channels.emplace_back(step);
        if (c == shape_.alpha) continue;
        steps.add(std::abs(step));
        magnitudes.add(sums.magnitude.value() / places);
        ++colours;
    }
    if (colours > 0) {
        result.mean_step = steps.value() / colours;
        result.local_step = magnitudes.value() / colours;
    }
    return result;
}

StepSummary summarize(std::span<const LineStep> lines) {
    StepSummary summary;
    Sum steps, magnitudes;
    double length = 0;
    for (const LineStep& step : lines) {
        if (!step.mean_step) continue;
        const double weight = step.line.to - step.line.from;
        ++summary.lines;
        length += weight;
        steps.add(weight * *step.mean_step);
        magnitudes.add(weight * *step.local_step);
    }
    if (length == 0) return summary;
    summary.mean_step = steps.value() / length;
    summary.local_step = magnitudes.value() / length;
    return summary;
}

}  // namespace mpipov
