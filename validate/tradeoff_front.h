// Error against time: which settings are worth their time, what accuracy costs, which one to take.
// Pure: numbers in, indices out.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace mpipov {

struct TradeoffPoint {
    double seconds = 0, error = 0;
};

// A setting that failed, or was not measured to the end, has none.
using TradeoffPoints = std::span<const std::optional<TradeoffPoint>>;

// The indices of those than which no other is both at least as fast and at least as accurate, by
// seconds. Of several with the same time and error the first.
std::vector<std::size_t> pareto_front(TradeoffPoints points);

// seconds = scale * error^-exponent, by least squares of log seconds over log error. Halving the
// error then costs 2^exponent times the time.
struct TradeoffLaw {
    double scale = 0;  // seconds at an error of 1
    double exponent = 0;
    double factor = 1;        // 2^exponent
    double residual = 1;      // exp of the RMS residual: typically off by this factor
    double from = 0, to = 0;  // errors that it was fitted over: the largest, the smallest
    std::size_t points = 0;
};

// None from fewer than two different errors above 0.
std::optional<TradeoffLaw> fit_law(std::span<const TradeoffPoint> front);

// The one with the least time of those whose error is at most `max_error`; of equally fast ones the
// most accurate, of those the first. None where no one is.
std::optional<std::size_t> cheapest_within(TradeoffPoints points, double max_error);
// The same the other way round.
std::optional<std::size_t> most_accurate_within(TradeoffPoints points, double max_seconds);

}  // namespace mpipov
