#include "tradeoff_front.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace mpipov {
namespace {

std::vector<std::size_t> by_seconds(TradeoffPoints points) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (points[i]) order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::tie(points[a]->seconds, points[a]->error) <
               std::tie(points[b]->seconds, points[b]->error);
    });
    return order;
}

}  // namespace

std::vector<std::size_t> pareto_front(TradeoffPoints points) {
    std::vector<std::size_t> front;
    for (const std::size_t i : by_seconds(points))
        if (front.empty() || points[i]->error < points[front.back()]->error) front.push_back(i);
    return front;
}

std::optional<TradeoffLaw> fit_law(std::span<const TradeoffPoint> front) {
    std::vector<TradeoffPoint> logs;
    for (const TradeoffPoint& point : front)
        if (point.error > 0 && point.seconds > 0)
            logs.push_back({std::log(point.seconds), std::log(point.error)});
    if (logs.size() < 2) return {};
    double x = 0, y = 0;
    for (const TradeoffPoint& log : logs) {
        x += log.error;
        y += log.seconds;
    }
    const auto count = static_cast<double>(logs.size());
    x /= count;
    y /= count;
    double xx = 0, xy = 0;
    for (const TradeoffPoint& log : logs) {
        xx += (log.error - x) * (log.error - x);
        xy += (log.error - x) * (log.seconds - y);
    }
    const auto [least, largest] = std::ranges::minmax(logs, {}, &TradeoffPoint::error);
    if (largest.error - least.error < std::log(2.0) * (1 - 1e-12)) return {};
    const double slope = xy / xx;
    TradeoffLaw law;
    law.scale = std::exp(y - slope * x);
    law.exponent = -slope;
    law.factor = std::exp2(law.exponent);
    law.points = logs.size();
    double square = 0, low = logs.front().error, high = low;
    for (const TradeoffPoint& log : logs) {
        const double off = log.seconds - (y + slope * (log.error - x));
        square += off * off;
        low = std::min(low, log.error);
        high = std::max(high, log.error);
    }
    law.residual = std::exp(std::sqrt(square / count));
    law.from = std::exp(high);
    law.to = std::exp(low);
    return law;
}

std::vector<TradeoffPoint> without_truths_error(std::span<const TradeoffPoint> points,
                                                double truths_error) {
    std::vector<TradeoffPoint> own;
    for (const TradeoffPoint& point : points)
        if (point.error >= 2 * truths_error)
            own.push_back({point.seconds,
                           std::sqrt(point.error * point.error - truths_error * truths_error)});
    return own;
}

std::optional<std::size_t> cheapest_within(TradeoffPoints points, double max_error) {
    for (const std::size_t i : by_seconds(points))
        if (points[i]->error <= max_error) return i;
    return {};
}

std::optional<std::size_t> most_accurate_within(TradeoffPoints points, double max_seconds) {
    std::optional<std::size_t> best;
    for (const std::size_t i : by_seconds(points))
        if (points[i]->seconds <= max_seconds && (!best || points[i]->error < points[*best]->error))
            best = i;
    return best;
}

}  // namespace mpipov
