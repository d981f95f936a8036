// Two reports as one number, as video codecs are compared (Bjontegaard 2001, VCEG-M33): how much less B costs at equal error, and
// how much smaller its error is at equal cost, in the geometric mean over what both curves reach. No device.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "replay/compare/curve.h"

namespace strata {

/// A row by what was measured of it.
struct SampledRow {
    double error = 0;
    std::vector<double> costs;  ///< one for each repeat, or one that is known; their median counts
    std::uint32_t stream = 0;   ///< random numbers by which its repeats are drawn: another stream for each row of both reports
};

/// Repeats are drawn anew, with replacement (Efron 1979, Ann. Statist. 7(1)), equally on every platform.
struct Bootstrap {
    std::uint32_t draws = 2000, seed = 1;
};
double drawn_cost(const SampledRow&, std::uint32_t draw, const Bootstrap&);

/// The value below which this share of the sorted values lies, between two of them by their distance.
double quantile(std::span<const double> sorted, double share);
/// The part in which 95 % of the sorted values lie.
Interval middle_of(std::span<const double> sorted);

/// The change from A to B.
struct Change {
    double ratio = 1;                    ///< geometric mean of B / A over the range: .88 is 12 % less
    Interval over;                       ///< range of errors (at equal error) or of costs that both curves reach
    std::optional<Interval> interval;    ///< 95 % interval of the ratio; none without repeats
    std::uint32_t draws_without_it = 0;  ///< draws whose curves reach no common range: they are left out of the interval
};

struct CurveComparison {
    std::vector<HullPoint> a, b;  ///< their points are indices of rows
    std::optional<Change> cost;   ///< at equal error; none where the curves have no range of errors in common
    std::optional<Change> error;  ///< at equal cost
    std::uint32_t draws = 0;      ///< on which the intervals rest
};
CurveComparison compare_curves(std::span<const SampledRow> a, std::span<const SampledRow> b, const Bootstrap& = {});

}  // namespace strata
