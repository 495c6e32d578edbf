#include "speedup_table.h"

#include <algorithm>
#include <numeric>

namespace mpipov {

std::optional<Spread> spread_of(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    const double median =
        values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
    return Spread{median, values.front(), values.back()};
}

std::vector<double> measured(const Times& times) {
    std::vector<double> values;
    for (const std::optional<double>& time : times)
        if (time) values.push_back(*time);
    return values;
}

std::optional<Spread> speed_up(const Times& serial, const Times& times) {
    std::vector<double> of_serial, of_variant, ratios;
    for (std::size_t i = 0; i < std::min(serial.size(), times.size()); ++i) {
        if (!serial[i] || !times[i] || !(*times[i] > 0)) continue;
        of_serial.push_back(*serial[i]);
        of_variant.push_back(*times[i]);
        ratios.push_back(*serial[i] / *times[i]);
    }
    std::optional<Spread> spread = spread_of(std::move(ratios));
    if (spread)
        spread->median =
            spread_of(std::move(of_serial))->median / spread_of(std::move(of_variant))->median;
    return spread;
}

std::optional<double> efficiency(const std::optional<Spread>& speed_up, int ranks) {
    if (!speed_up || ranks < 1) return {};
    return speed_up->median / ranks;
}

std::vector<std::size_t> run_order(std::size_t count, int repetition, int repetitions) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (count == 0 || repetitions < 1) return order;
    const auto turn = static_cast<std::size_t>(repetition % repetitions);
    const auto turns = static_cast<std::size_t>(repetitions);
    // At least one step a repetition; where there are more repetitions than variants, round again.
    const std::size_t by = turns <= count ? turn * count / turns : turn % count;
    std::rotate(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(by), order.end());
    return order;
}

}  // namespace mpipov
