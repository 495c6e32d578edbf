// When is a number too large to be chance? Pure.
#pragma once

#include <cstddef>
#include <vector>

namespace mpipov {

// Sidak's correction: the significance of each of `tests` tests of which one false alarm among all
// of them has probability alpha. 1 - (1 - alpha)^(1 / tests)
double sidak(double alpha, double tests);

// The value that a t-distributed one exceeds with probability p (one-sided); p in (0, 1).
// Throws std::invalid_argument where degrees < 1.
double t_quantile(double p, int degrees);

// The largest of very many values: what is needed of a tail, in little memory.
class TailSample {
  public:
    static constexpr std::size_t kept = 64;

    void add(double value);
    void add(const TailSample& other);
    long long count() const { return count_; }
    std::vector<double> largest() const;  // descending, at most `kept`

  private:
    long long count_ = 0;
    std::vector<double> heap_;  // the smallest on top
};

// The value that one of the population of `quiet` exceeds with probability p, where p may be less
// than 1 / count: Weissman's estimate, x(m+1) (m / (count p))^xi, with Hill's
// xi = mean over i <= m of log(x(i) / x(m+1)), m = 20 (fewer where the sample is small: one in a
// hundred), taken at the upper end of its one-sided 95 % interval, xi (1 + 1.645 / sqrt(m)). A
// sample too small for that (m < 8) says no more than its largest value. Never less than
// `theoretical`, which is also the answer where there are fewer than 8 values or no tail.
double critical_value(const TailSample& quiet, double p, double theoretical);

}  // namespace mpipov
