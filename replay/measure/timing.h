// Times with their spread.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace strata {

/// Median and median absolute deviation of repeated measurements.
struct Spread {
    double median = 0, mad = 0, low = 0, high = 0;
    std::size_t repeats = 0;
};

/// The middle one of at least one value; of an even number of values the mean of the middle two.
double median_of(std::vector<double>);
Spread spread_of(std::span<const double> values);
/// Of values[i] / units[i]: what both were measured under in turn i, a busy machine say, cancels. Both as long.
Spread ratio_of(std::span<const double> values, std::span<const double> units);

}  // namespace strata
