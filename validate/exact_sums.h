// What sums of errors are in quadruple precision: the reference of the tests.
#pragma once

#include "metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mpipov {

#ifdef __SIZEOF_FLOAT128__
__extension__ using Quad = __float128;
#else
using Quad = long double;
static_assert(std::numeric_limits<long double>::digits >= 113, "there is no quadruple precision");
#endif

struct QuadSums {
    long long samples = 0;
    Quad signed_sum = 0, absolute = 0, square = 0;

    void add(double a, double b) {
        const Quad error = Quad(b) - Quad(a);
        ++samples;
        signed_sum += error;
        absolute += error < 0 ? -error : error;
        square += error * error;
    }
    Quad mean_abs() const { return absolute / samples; }
    Quad mean_signed() const { return signed_sum / samples; }
    double rms() const { return std::sqrt(static_cast<double>(square / samples)); }
};

// How far off the three are: mean_abs and RMS relative to themselves, mean_signed to mean_abs.
struct Inaccuracy {
    double mean_abs = 0, mean_signed = 0, rms = 0;

    Inaccuracy(const ErrorSums& found, const QuadSums& exact) {
        const auto off = [](double value, Quad truth, Quad scale) {
            const Quad by = (Quad(value) - truth) / scale;
            return std::abs(static_cast<double>(by));
        };
        mean_abs = off(*found.mean_abs(), exact.mean_abs(), exact.mean_abs());
        mean_signed = off(*found.mean_signed(), exact.mean_signed(), exact.mean_abs());
        rms = off(*found.rms(), exact.rms(), exact.rms());
    }
    double worst() const { return std::max({mean_abs, mean_signed, rms}); }
};

}  // namespace mpipov
