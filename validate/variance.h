// Mean and variance of few values that may lie far from 0 and close to each other. Pure.
#pragma once

#include <span>
#include <vector>

namespace mpipov {

// One value after the other (Welford 1962), as differences from the first one: of values around
// 1e6 with a deviation of 1e-3 nothing is lost. A value that is not finite makes both no number.
class Welford {
  public:
    void add(double value) {
        if (count_ == 0) first_ = value;
        const double moved = value - first_, off = moved - mean_;
        mean_ += off / static_cast<double>(++count_);
        squares_ += off * (moved - mean_);
    }
    // Of other values (Chan, Golub, LeVeque 1983).
    void add(const Welford& other);

    long long count() const { return count_; }
    double mean() const { return first_ + mean_; }
    // Of the population that the values were drawn from; 0 of fewer than two.
    double variance() const { return count_ < 2 ? 0 : squares_ / static_cast<double>(count_ - 1); }

  private:
    long long count_ = 0;
    double first_ = 0;
    double mean_ = 0, squares_ = 0;  // of value - first_
};

// For each of the values that of all the others, without ever taking one away again: beside an
// outlier that would leave nothing of their variance. Where the value itself is not finite, so is
// the answer. `rest` is given the length of `values`.
void each_without_one(std::span<const double> values, std::vector<Welford>& rest);

}  // namespace mpipov
