#include "variance.h"

#include <cmath>

namespace mpipov {

void Welford::add(const Welford& other) {
    if (other.count_ == 0) return;
    if (count_ == 0) {
        *this = other;
        return;
    }
    const auto mine = static_cast<double>(count_), theirs = static_cast<double>(other.count_);
    const double off = (other.first_ - first_) + (other.mean_ - mean_);
    mean_ += off * theirs / (mine + theirs);
    squares_ += other.squares_ + off * off * mine * theirs / (mine + theirs);
    count_ += other.count_;
}

void each_without_one(std::span<const double> values, std::vector<Welford>& rest) {
    rest.assign(values.size(), {});
    Welford before;
    for (std::size_t i = 0; i < values.size(); ++i) {
        rest[i] = before;
        before.add(values[i]);
    }
    Welford after;
    for (std::size_t i = values.size(); i-- > 0;) {
        rest[i].add(after);
        if (!std::isfinite(values[i])) rest[i].add(values[i]);
        after.add(values[i]);
    }
}

}  // namespace mpipov
