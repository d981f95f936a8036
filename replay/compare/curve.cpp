#include "replay/compare/curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "replay/report/ranking.h"

namespace strata {
namespace {

using Knot = DecreasingCurve::Knot;

/// True of a middle point that does not lie below the line through the other two.
bool is_no_corner(const HullPoint& before, const HullPoint& middle, const HullPoint& after) {
    return (middle.log_cost - before.log_cost) * (after.log_error - middle.log_error) >=
           (after.log_cost - middle.log_cost) * (middle.log_error - before.log_error);
}

[[maybe_unused]] bool is_decreasing(std::span<const Knot> knots) {
    return std::ranges::adjacent_find(knots, [](const Knot& a, const Knot& b) { return !(a.x < b.x && a.y > b.y); }) ==
           knots.end();
}

/// The slopes of the lines between knots with two more at each end: Akima's rule, a parabola through the last three knots.
std::vector<double> with_ends(const std::vector<double>& slopes) {
    const double first = slopes.front(), last = slopes.back();
    const double step = slopes[1] - first, last_step = last - slopes[slopes.size() - 2];
    std::vector<double> all{first - 2 * step, first - step};
    all.insert(all.end(), slopes.begin(), slopes.end());
    all.insert(all.end(), {last + last_step, last + 2 * last_step});
    return all;
}

/// At the knot between the two slopes in the middle of four.
double akima_tangent(std::span<const double, 4> slopes) {
    const double left = std::abs(slopes[3] - slopes[2]), right = std::abs(slopes[1] - slopes[0]);
    if (left + right == 0) return (slopes[1] + slopes[2]) / 2;
    return (left * slopes[1] + right * slopes[2]) / (left + right);
}

std::vector<double> tangents_of(std::span<const Knot> knots) {
    std::vector<double> slopes;
    for (std::size_t i = 0; i + 1 < knots.size(); ++i)
        slopes.push_back((knots[i + 1].y - knots[i].y) / (knots[i + 1].x - knots[i].x));
    if (slopes.size() == 1) return {slopes.front(), slopes.front()};
    const std::vector<double> all = with_ends(slopes);
    std::vector<double> tangents;
    for (std::size_t i = 0; i < knots.size(); ++i) {
        const double flatter = std::max(slopes[i == 0 ? 0 : i - 1], slopes[std::min(i, slopes.size() - 1)]);
        tangents.push_back(std::clamp(akima_tangent(std::span(all).subspan(i).first<4>()), 3 * flatter, 0.0));
    }
    return tangents;
}

}  // namespace

Interval common_part(const Interval& a, const Interval& b) { return {std::max(a.low, b.low), std::min(a.high, b.high)}; }

std::vector<HullPoint> hull_of(std::span<const CostPoint> points) {
    std::vector<HullPoint> sorted;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (points[i].cost > 0) sorted.push_back({std::log(std::max(points[i].error, exact_below)), std::log(points[i].cost), i});
    std::ranges::sort(sorted, [](const HullPoint& a, const HullPoint& b) {
        return a.log_error != b.log_error ? a.log_error < b.log_error : a.log_cost < b.log_cost;
    });
    std::vector<HullPoint> hull;
    double cheapest = HUGE_VAL;
    for (const HullPoint& point : sorted) {
        if (!(point.log_cost < cheapest)) continue;
        cheapest = point.log_cost;
        while (hull.size() > 1 && is_no_corner(hull[hull.size() - 2], hull.back(), point)) hull.pop_back();
        hull.push_back(point);
    }
    return hull;
}

Interval errors_of(std::span<const HullPoint> hull) { return {hull.front().log_error, hull.back().log_error}; }
Interval costs_of(std::span<const HullPoint> hull) { return {hull.back().log_cost, hull.front().log_cost}; }

DecreasingCurve::DecreasingCurve(std::span<const Knot> knots) {
    assert(knots.size() > 1 && is_decreasing(knots));
    const std::vector<double> tangents = tangents_of(knots);
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
        const double width = knots[i + 1].x - knots[i].x, line = (knots[i + 1].y - knots[i].y) / width;
        pieces_.push_back({.begin = knots[i].x,
                           .width = width,
                           .y = knots[i].y,
                           .linear = tangents[i],
                           .square = 3 * line - 2 * tangents[i] - tangents[i + 1],
                           .cube = tangents[i] + tangents[i + 1] - 2 * line});
    }
}

std::size_t DecreasingCurve::piece_at(double x) const {
    const auto after = std::ranges::upper_bound(pieces_.begin() + 1, pieces_.end(), x, {}, &Piece::begin);
    return std::size_t(after - pieces_.begin()) - 1;
}

double DecreasingCurve::at(double x) const {
    const Piece& piece = pieces_[piece_at(x)];
    const double s = (x - piece.begin) / piece.width;
    return piece.y + piece.width * s * (piece.linear + s * (piece.square + s * piece.cube));
}

double DecreasingCurve::integral(double from, double to) const {
    double sum = 0;
    for (std::size_t i = piece_at(from), last = piece_at(to); i <= last; ++i) {
        const Piece& piece = pieces_[i];
        const auto from_its_begin = [&](double s) {
            return piece.width * s *
                   (piece.y + piece.width * s * (piece.linear / 2 + s * (piece.square / 3 + s * piece.cube / 4)));
        };
        sum += from_its_begin(i == last ? (to - piece.begin) / piece.width : 1);
        if (from > piece.begin) sum -= from_its_begin((from - piece.begin) / piece.width);
    }
    return sum;
}

DecreasingCurve cost_over_error(std::span<const HullPoint> hull) {
    std::vector<Knot> knots;
    for (const HullPoint& point : hull) knots.push_back({point.log_error, point.log_cost});
    return DecreasingCurve(knots);
}

DecreasingCurve error_over_cost(std::span<const HullPoint> hull) {
    std::vector<Knot> knots;
    for (const HullPoint& point : hull) knots.push_back({point.log_cost, point.log_error});
    std::ranges::reverse(knots);
    return DecreasingCurve(knots);
}

}  // namespace strata
