#include "noise_floor.h"

#include <algorithm>
#include <cmath>

namespace mpipov {

double Quantisation::step(double value, double brightest) const {
    switch (kind) {
        case Kind::levels:
            return 1;
        case Kind::half:
            return std::max(std::abs(value) * 0x1p-10, 0x1p-24);
        case Kind::shared_exponent:
            return std::max(std::abs(brightest) * 0x1p-7, 0x1p-24);
        case Kind::float32:
            break;
    }
    return std::max(std::abs(value) * 0x1p-23, 0x1p-48);
}

double Quantisation::variance(double value, double brightest) const {
    const double size = step(value, brightest);
    return size * size / 12;
}

void NoiseFloorBuilder::add_row(int y, std::span<const std::span<const double>> renders) {
    floor_.renders = static_cast<int>(renders.size());
    for (std::size_t i = 0; i < renders.front().size(); ++i) {
        Welford over;
        for (const auto& render : renders) over.add(render[i]);
        const double variance = over.variance();
        if (!std::isfinite(variance)) continue;
        ++floor_.samples;
        const double first = renders.front()[i];
        if (std::all_of(renders.begin(), renders.end(),
                        [&](const auto& render) { return render[i] == first; }))
            continue;
        ++floor_.noisy;
        variances_.add(variance);
        if (const double sigma = std::sqrt(variance); sigma > floor_.largest_sigma) {
            floor_.largest_sigma = sigma;
            floor_.x = static_cast<int>(i) / shape_.channels;
            floor_.y = y;
            floor_.channel = static_cast<int>(i) % shape_.channels;
        }
    }
}

NoiseFloor NoiseFloorBuilder::result() const {
    NoiseFloor floor = floor_;
    if (floor.samples > 0)
        floor.sigma = std::sqrt(variances_.value() / static_cast<double>(floor.samples));
    return floor;
}

}  // namespace mpipov
