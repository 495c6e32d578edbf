// The arithmetic of measured speed-ups. Pure: seconds in, numbers out.
//
// Variants are measured in turns: one repetition runs each once, so that what the machine does
// beside it meets all of them. A time or a ratio is told as its median over the repetitions, and
// its spread as the smallest and the largest: with few repetitions nothing finer means anything.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace mpipov {

struct Spread {
    double median = 0, low = 0, high = 0;  // low, high: smallest, largest
};

// Of an even number of values the median is the mean of the two in the middle. None of no values.
std::optional<Spread> spread_of(std::vector<double> values);

// Wall seconds of one variant by repetition; none where it was not run, or failed.
using Times = std::vector<std::optional<double>>;

std::vector<double> measured(const Times& times);

// How many times as fast as the serial render, from the repetitions in which both were measured.
// median: the serial median through the variant's, as one would divide the two in a table. low,
// high: of the ratios within one repetition; the median always lies between them.
std::optional<Spread> speed_up(const Times& serial, const Times& times);

// Speed-up by processor.
std::optional<double> efficiency(const std::optional<Spread>& speed_up, int ranks);

// In which order the variants 0..count-1 are run in a repetition: the first one as they are, later
// ones rotated, over all repetitions by equal steps, so that none is always early or late. The
// first of the first repetition is variant 0.
std::vector<std::size_t> run_order(std::size_t count, int repetition, int repetitions);

}  // namespace mpipov
