#include "significance.h"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace mpipov {

double sidak(double alpha, double tests) {
    return tests <= 1 ? alpha : -std::expm1(std::log1p(-alpha) / tests);
}

double t_quantile(double p, int degrees) {
    if (degrees < 1) throw std::invalid_argument("a t distribution needs a degree of freedom");
    return boost::math::quantile(boost::math::complement(boost::math::students_t(degrees), p));
}

void TailSample::add(double value) {
    ++count_;
    if (heap_.size() < kept) {
        heap_.push_back(value);
        std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    } else if (value > heap_.front()) {
        std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
        heap_.back() = value;
        std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    }
}

void TailSample::add(const TailSample& other) {
    const long long count = count_ + other.count_;
    for (const double value : other.heap_) add(value);
    count_ = count;
}

std::vector<double> TailSample::largest() const {
    std::vector<double> values = heap_;
    std::sort(values.begin(), values.end(), std::greater<>());
    return values;
}

double critical_value(const TailSample& quiet, double p, double theoretical) {
    // Of the values the largest in a hundred are a tail; more of them, and Hill's estimate is of
    // the body, and far too large.
    constexpr std::size_t of_the_tail = 20, fewest = 8, tail_is_one_in = 100;
    constexpr double one_sided_95 = 1.645;
    const std::vector<double> x = quiet.largest();
    if (x.size() < fewest || !std::isfinite(x[0])) return theoretical;
    const auto tail = static_cast<std::size_t>(quiet.count()) / tail_is_one_in;
    const std::size_t m = std::min({of_the_tail, tail, x.size() - 1});
    if (m < fewest) return std::max(theoretical, x[0]);
    if (!(x[m] > 0)) return theoretical;
    double xi = 0;
    for (std::size_t i = 0; i < m; ++i) xi += std::log(x[i] / x[m]);
    xi /= static_cast<double>(m);
    // An index that is estimated too small half of the time lets false alarms through.
    xi *= 1 + one_sided_95 / std::sqrt(static_cast<double>(m));
    const double beyond = static_cast<double>(m) / (static_cast<double>(quiet.count()) * p);
    return std::max(theoretical, x[m] * std::pow(beyond, xi));
}

}  // namespace mpipov
