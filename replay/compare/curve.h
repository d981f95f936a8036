// Error against cost as a curve: the lower convex hull of a report's rows on logarithmic axes, and the curve through it. No
// device.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace strata {

struct Interval {
    double low = 0, high = 0;
    /// Ends of two ranges that meet differ by rounding: a millionth of a logarithm is no range.
    bool is_empty() const { return !(high - low > 1e-6); }
};
Interval common_part(const Interval&, const Interval&);

/// A row of a report by its error and its cost.
struct CostPoint {
    double error = 0;  ///< 0 or more
    double cost = 0;   ///< those of 0, which a coarse clock measures, are on no curve
};

/// A corner of a hull.
struct HullPoint {
    double log_error = 0, log_cost = 0;
    std::size_t point = 0;  ///< index of the point that it is
};

/// The lower convex hull in (log error, log cost), as far as cost falls while error rises; errors increase strictly, costs
/// decrease strictly. Errors below exact_below (replay/measure/exact_below.h) count as exact_below, because the axis has no 0: of
/// several such points only the cheapest remains.
std::vector<HullPoint> hull_of(std::span<const CostPoint>);
Interval errors_of(std::span<const HullPoint>);  ///< logarithms
Interval costs_of(std::span<const HullPoint>);   ///< logarithms

/// A decreasing curve through knots: cubic pieces with the slopes of Akima 1970 (J. ACM 17(4), with its rule for the ends), of
/// two knots a line. Beside a sharp bend those slopes overshoot; each is limited to between 0 and three times the flatter slope
/// of the lines beside it, within which a cubic piece is monotone (Fritsch and Carlson 1980, SIAM J. Numer. Anal. 17(2)).
class DecreasingCurve {
public:
    struct Knot {
        double x = 0, y = 0;
    };
    /// At least two knots of which x increases and y decreases, both strictly.
    explicit DecreasingCurve(std::span<const Knot>);
    double at(double x) const;
    /// Between two places of its domain; closed form.
    double integral(double from, double to) const;

private:
    /// y + width s (linear + s (square + s cube)), s from 0 to 1.
    struct Piece {
        double begin = 0, width = 0, y = 0, linear = 0, square = 0, cube = 0;
    };
    std::size_t piece_at(double x) const;

    std::vector<Piece> pieces_;
};

/// The curve through a hull of at least two points: log cost over log error, and log error over log cost.
DecreasingCurve cost_over_error(std::span<const HullPoint>);
DecreasingCurve error_over_cost(std::span<const HullPoint>);

}  // namespace strata
