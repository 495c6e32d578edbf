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
// error then costs 2^exponent times the time. Only what spans a halving at least says that.
struct TradeoffLaw {
    double scale = 0;  // seconds at an error of 1
    double exponent = 0;
    double factor = 1;        // 2^exponent
    double residual = 1;      // exp of the RMS residual: typically off by this factor
    double from = 0, to = 0;  // errors that it was fitted over: the largest, the smallest
    std::size_t points = 0;
};

// None where the largest error is less than twice the smallest one above 0.
std::optional<TradeoffLaw> fit_law(std::span<const TradeoffPoint> front);

// The settings' own errors, from errors that were measured against a truth with an error of its
// own: what is measured is both, as the root of the sum of their squares. Points whose error is
// less than twice the truth's are left out: what would be left of them is mostly guessed.
std::vector<TradeoffPoint> without_truths_error(std::span<const TradeoffPoint> points,
                                                double truths_error);

// The one with the least time of those whose error is at most `max_error`; of equally fast ones the
// most accurate, of those the first. None where no one is.
std::optional<std::size_t> cheapest_within(TradeoffPoints points, double max_error);
// The same the other way round.
std::optional<std::size_t> most_accurate_within(TradeoffPoints points, double max_seconds);

}  // namespace mpipov
