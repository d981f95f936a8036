// Whether results with random numbers have the mean that they should have, value by value: the test of Mitsuba's renderers
// (Jakob et al.), a t-test of each value by its own variance, corrected after Sidak for their number.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace strata {

/// Collects runs that differ in their random numbers alone. Each has the same number of values; their sum is one more.
class ZTest {
public:
    void add(std::span<const double> run) {
        if (sums_.empty()) sums_.resize(run.size() + 1), squares_.resize(run.size() + 1);
        assert(sums_.size() == run.size() + 1);
        double total = 0;
        for (std::size_t i = 0; i < run.size(); ++i) {
            add(i, run[i]);
            total += run[i];
        }
        add(run.size(), total);
        ++runs_;
    }

    /// How probable means as far from the expected ones are by chance, 0 to 1: of the least probable of all values. Less than
    /// `slack` of the expected value is no distance: what stored numbers are rounded to.
    double probability(std::span<const double> expected, double slack) const {
        double least = 1;
        for (std::size_t i = 0; i < expected.size(); ++i) least = std::min(least, probability(i, expected[i], slack));
        const double total = std::accumulate(expected.begin(), expected.end(), 0.0);
        least = std::min(least, probability(expected.size(), total, slack));
        return -std::expm1(double(expected.size() + 1) * std::log1p(-least));
    }

private:
    void add(std::size_t i, double value) {
        sums_[i] += value;
        squares_[i] += value * value;
    }

    double probability(std::size_t i, double expected, double slack) const {
        const double n = runs_, mean = sums_[i] / n;
        const double variance = std::max(0.0, squares_[i] / n - mean * mean) / (n - 1);  // of the mean
        const double distance = std::max(0.0, std::abs(mean - expected) - slack * std::abs(expected));
        if (distance == 0) return 1;
        // Wallace's normal deviate of a t-value (1959), within a hundredth of the tail's for 10 degrees of freedom and more.
        const double freedom = n - 1, t2 = distance * distance / variance;
        const double z = (8 * freedom + 1) / (8 * freedom + 3) * std::sqrt(freedom * std::log1p(t2 / freedom));
        return std::min(std::erfc(z / std::sqrt(2.0)), 1 - 1e-16);
    }

    double runs_ = 0;
    std::vector<double> sums_, squares_;
};

}  // namespace strata
