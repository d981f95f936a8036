// Exact probabilities of counts of independent lots: a test with them asks for no more and no less than chance allows.
#pragma once

#include <cmath>
#include <cstdint>

namespace strata {

/// A fair count is this far in a tail once in ten million tests. Lots that follow a hash are the same in every run.
inline constexpr double hardly_ever = 1e-7;

/// Probability of exactly k of n lots that each succeed with probability p.
inline double binomial(double k, double n, double p) {
    if (p <= 0 || p >= 1) return k == n * (p <= 0 ? 0 : 1) ? 1 : 0;
    const double ways = std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1);
    return std::exp(ways + k * std::log(p) + (n - k) * std::log1p(-p));
}

/// Probability of k or fewer successes, or of k or more: the smaller of the two.
inline double binomial_tail(double k, double n, double p) {
    const double step = k < n * p ? -1 : 1;
    double term = binomial(k, n, p), sum = 0;
    for (double i = k; term > sum * 1e-15; i += step) {
        sum += term;
        if (i + step < 0 || i + step > n) break;
        // The ratio of a term to its neighbor, away from the mean.
        term *= step < 0 ? i / (n - i + 1) * (1 - p) / p : (n - i) / (i + 1) * p / (1 - p);
    }
    return sum;
}

}  // namespace strata
