#include "pixel_scores.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mpipov {

PixelScores::PixelScores(const ImageShape& shape, const Quantisation& quantisation, Judge judge,
                         Sink sink, double spread)
    : shape_(shape),
      quantisation_(quantisation),
      judge_(judge),
      sink_(std::move(sink)),
      spread_(spread) {}

void PixelScores::add_row(int y, std::span<const std::span<const double>> renders,
                          std::span<const double> image) {
    const std::size_t samples = renders.front().size();
    const bool leave_one_out = judge_ == Judge::renders;
    const auto n = static_cast<long long>(renders.size());
    others_ = leave_one_out ? n - 1 : n;
    if (rows_.size() == 3) rows_.pop_front();
    Row& row = rows_.emplace_back();
    row.y = y;
    row.judged.resize(leave_one_out ? renders.size() : 1);
    for (std::size_t j = 0; j < row.judged.size(); ++j) {
        const auto values = leave_one_out ? renders[j] : image;
        row.judged[j].value.assign(values.begin(), values.end());
        row.judged[j].expected.resize(samples);
        row.judged[j].variance.resize(samples);
    }
    std::vector<double> values(renders.size());
    std::vector<Welford> rest;
    for (std::size_t i = 0; i < samples; ++i) {
        std::ranges::transform(renders, values.begin(),
                               [i](const auto& render) { return render[i]; });
        if (leave_one_out) {
            each_without_one(values, rest);
        } else {
            rest.assign(1, {});
            for (const double value : values) rest[0].add(value);
        }
        for (std::size_t j = 0; j < row.judged.size(); ++j) {
            row.judged[j].expected[i] = rest[j].mean();
            row.judged[j].variance[i] = rest[j].variance();
        }
    }
    if (rows_.size() >= 2) emit(rows_.size() - 2);
}

void PixelScores::finish() {
    if (rows_.empty()) return;
    if (rows_.size() == 3) rows_.pop_front();
    emit(rows_.size() - 1);
    rows_.clear();
}

void PixelScores::emit(std::size_t index) {
    const std::size_t first = index == 0 ? 0 : index - 1;
    const std::size_t last = std::min(index + 1, rows_.size() - 1);
    const auto finite_or_zero = [](double v) { return std::isfinite(v) ? v : 0; };
    const auto channels = static_cast<std::size_t>(shape_.channels);
    const Row& row = rows_[index];
    for (std::size_t j = 0; j < row.judged.size(); ++j) {
        const Judged& judged = row.judged[j];
        const std::size_t samples = judged.value.size();
        column_.assign(samples, 0);
        z_.resize(samples);
        sigma_.resize(samples);
        for (std::size_t r = first; r <= last; ++r)
            for (std::size_t i = 0; i < samples; ++i)
                column_[i] += finite_or_zero(rows_[r].judged[j].variance[i]);
        for (std::size_t i = 0; i < samples; ++i) {
            double sum = column_[i];
            auto cells = static_cast<double>(last - first + 1);
            const double column_cells = cells;
            if (i >= channels) {
                sum += column_[i - channels];
                cells += column_cells;
            }
            if (i + channels < samples) {
                sum += column_[i + channels];
                cells += column_cells;
            }
            const auto pixel =
                judged.expected.begin() + static_cast<std::ptrdiff_t>(i - i % channels);
            const double brightest =
                *std::max_element(pixel, pixel + static_cast<std::ptrdiff_t>(channels));
            const double variance =
                std::max(judged.variance[i], sum / cells) +
                quantisation_.variance(judged.expected[i], finite_or_zero(brightest));
            sigma_[i] = std::sqrt(variance * factor(others_));
            if (!std::isfinite(judged.expected[i]) || !std::isfinite(sigma_[i]))
                z_[i] = std::numeric_limits<double>::quiet_NaN();
            else if (!std::isfinite(judged.value[i]))
                z_[i] = std::numeric_limits<double>::infinity();
            else
                z_[i] = std::abs(judged.value[i] - judged.expected[i]) / sigma_[i];
        }
        sink_({row.y, judge_ == Judge::renders ? static_cast<int>(j) : -1, z_, judged.value,
               judged.expected, sigma_});
    }
}

}  // namespace mpipov
