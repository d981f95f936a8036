#include "replay/measure/timing.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace strata {

double median_of(std::vector<double> values) {
    const std::size_t middle = values.size() / 2;
    std::ranges::sort(values);
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

Spread spread_of(std::span<const double> values) {
    if (values.empty()) return {};
    Spread spread{.repeats = values.size()};
    spread.median = median_of({values.begin(), values.end()});
    std::vector<double> deviations;
    for (const double value : values) deviations.push_back(std::abs(value - spread.median));
    spread.mad = median_of(std::move(deviations));
    const auto [low, high] = std::ranges::minmax(values);
    spread.low = low;
    spread.high = high;
    return spread;
}

Spread ratio_of(std::span<const double> values, std::span<const double> units) {
    assert(values.size() == units.size());
    std::vector<double> ratios;
    for (std::size_t i = 0; i < values.size(); ++i) ratios.push_back(values[i] / units[i]);
    return spread_of(ratios);
}

}  // namespace strata
