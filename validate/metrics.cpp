#include "metrics.h"

#include <algorithm>

namespace mpipov {

bool pixel_differs(const double* a, const double* b, int channels) {
    for (int c = 0; c < channels; ++c)
        if (!same_value(a[c], b[c])) return true;
    return false;
}

std::optional<double> ErrorSums::mean(const Sum& sum) const {
    if (samples_ == 0) return {};
    return sum.value() / static_cast<double>(samples_);
}

void ErrorSums::add(const ErrorSums& other) {
    samples_ += other.samples_;
    signed_.add(other.signed_);
    absolute_.add(other.absolute_);
    square_.add(other.square_);
    max_ = std::max(max_, other.max_);
}

std::optional<double> ErrorSums::rms() const {
    const auto square = mean(square_);
    if (!square || !std::isfinite(*square)) return {};
    return std::sqrt(*square);
}

std::optional<double> ErrorSums::max() const {
    if (samples_ == 0) return {};
    return max_;
}

std::optional<double> Metrics::psnr(double peak) const {
    const auto rms = all.rms();
    if (!rms || *rms == 0) return {};
    return 20 * std::log10(peak / *rms);
}

std::string_view Metrics::why_no_psnr() const {
    if (all.samples() == 0) return "undefined: no sample is finite in both images";
    const auto rms = all.rms();
    if (!rms) return "undefined: the square of an error is beyond a double";
    return *rms == 0 ? "infinite: no finite sample has an error" : "";
}

MetricsBuilder::MetricsBuilder(const ImageShape& shape) : shape_(shape) {
    metrics_.channels.resize(static_cast<std::size_t>(shape.channels));
}

void MetricsBuilder::note_nonfinite(int x, int y, int channel, double a, double b) {
    NonFinite& found = metrics_.nonfinite;
    const auto note = [&](char image, double value, long long& nans, long long& infinities,
                          std::size_t& places) {
        if (std::isfinite(value)) return;
        ++(std::isnan(value) ? nans : infinities);
        if (places >= NonFinite::places_kept) return;
        ++places;
        found.first.push_back({image, x, y, channel, value});
    };
    note('a', a, found.nan_a, found.infinite_a, places_a_);
    note('b', b, found.nan_b, found.infinite_b, places_b_);
    if (!same_value(a, b)) ++found.mismatches;
}

void MetricsBuilder::add_sample(int x, int y, int channel, double a, double b) {
    if (!std::isfinite(a) || !std::isfinite(b)) {
        note_nonfinite(x, y, channel, a, b);
        return;
    }
    metrics_.channels[static_cast<std::size_t>(channel)].add(a, b);
    if (a == b && !same_value(a, b)) ++metrics_.zero_signs;
    const auto error = std::abs(b - a);
    auto& largest = metrics_.largest;
    if (error > 0 && (!largest || error > std::abs(largest->b - largest->a)))
        largest = LargestError{x, y, channel, a, b};
}

void MetricsBuilder::add_row(int y, std::span<const double> a, std::span<const double> b) {
    metrics_.counts.pixels += shape_.width;
    const auto finite_and_equal = [](double p, double q) {
        return same_value(p, q) && std::isfinite(p);
    };
    if (std::equal(a.begin(), a.end(), b.begin(), finite_and_equal)) {
        for (ErrorSums& channel : metrics_.channels) channel.add_equal(shape_.width);
        return;
    }
    const auto channels = static_cast<std::size_t>(shape_.channels);
    for (int x = 0; x < shape_.width; ++x) {
        const std::size_t at = static_cast<std::size_t>(x) * channels;
        for (int c = 0; c < shape_.channels; ++c) {
            const std::size_t i = at + static_cast<std::size_t>(c);
            add_sample(x, y, c, a[i], b[i]);
        }
        if (!pixel_differs(&a[at], &b[at], shape_.channels)) continue;
        Rect& box = metrics_.differing_box;
        box = metrics_.counts.differing++ == 0
                  ? Rect{x, y, x + 1, y + 1}
                  : Rect{std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1),
                         std::max(box.y1, y + 1)};
    }
}

Metrics MetricsBuilder::result() const {
    Metrics metrics = metrics_;
    for (const ErrorSums& channel : metrics.channels) metrics.all.add(channel);
    return metrics;
}

}  // namespace mpipov
