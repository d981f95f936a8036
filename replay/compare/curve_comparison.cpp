#include "replay/compare/curve_comparison.h"

#include <algorithm>
#include <cmath>

#include "passes/shaders/hash.shared.h"
#include "replay/measure/timing.h"

namespace strata {
namespace {

using Hull = std::vector<HullPoint>;

/// The mean distance of two curves, B - A, in logarithms.
struct LogChange {
    double mean = 0;
    Interval over;
};
struct LogChanges {
    std::optional<LogChange> cost, error;
};

std::optional<LogChange> change_of(const DecreasingCurve& a, const DecreasingCurve& b, const Interval& over) {
    if (over.is_empty()) return {};
    const double apart = b.integral(over.low, over.high) - a.integral(over.low, over.high);
    return LogChange{apart / (over.high - over.low), over};
}

LogChanges changes_of(const Hull& a, const Hull& b) {
    if (a.size() < 2 || b.size() < 2) return {};
    return {change_of(cost_over_error(a), cost_over_error(b), common_part(errors_of(a), errors_of(b))),
            change_of(error_over_cost(a), error_over_cost(b), common_part(costs_of(a), costs_of(b)))};
}

Hull drawn_hull(std::span<const SampledRow> rows, std::uint32_t draw, const Bootstrap& bootstrap) {
    std::vector<CostPoint> points;
    for (const SampledRow& row : rows) points.push_back({row.error, drawn_cost(row, draw, bootstrap)});
    return hull_of(points);
}

Hull hull_of_rows(std::span<const SampledRow> rows) {
    std::vector<CostPoint> points;
    for (const SampledRow& row : rows) points.push_back({row.error, median_of(row.costs)});
    return hull_of(points);
}

bool varies(std::span<const SampledRow> rows, const Hull& hull) {
    return std::ranges::any_of(hull, [&](const HullPoint& corner) { return rows[corner.point].costs.size() > 1; });
}

/// Puts what the draws gave into the change that they are of.
void add_interval(std::optional<Change>& change, std::vector<double> means, std::uint32_t draws) {
    if (!change) return;
    change->draws_without_it = draws - static_cast<std::uint32_t>(means.size());
    if (means.empty()) return;
    std::ranges::sort(means);
    const Interval middle = middle_of(means);
    change->interval = Interval{std::exp(middle.low), std::exp(middle.high)};
}

std::optional<Change> in_units(const std::optional<LogChange>& change) {
    if (!change) return {};
    return Change{.ratio = std::exp(change->mean), .over = {std::exp(change->over.low), std::exp(change->over.high)}};
}

}  // namespace

double drawn_cost(const SampledRow& row, std::uint32_t draw, const Bootstrap& bootstrap) {
    const std::uint32_t key = hashed(bootstrap.seed, {row.stream, draw, 0});
    const std::uint64_t count = row.costs.size();
    std::vector<double> drawn;
    drawn.reserve(row.costs.size());
    for (std::uint32_t i = 0; i < count; ++i) drawn.push_back(row.costs[(hashed(key + i) * count) >> 32]);
    return median_of(std::move(drawn));
}

double quantile(std::span<const double> sorted, double share) {
    const double place = share * double(sorted.size() - 1);
    const auto below = std::size_t(place);
    const double above = sorted[std::min(below + 1, sorted.size() - 1)];
    return sorted[below] + (place - double(below)) * (above - sorted[below]);
}

Interval middle_of(std::span<const double> sorted) { return {quantile(sorted, .025), quantile(sorted, .975)}; }

CurveComparison compare_curves(std::span<const SampledRow> a, std::span<const SampledRow> b, const Bootstrap& bootstrap) {
    CurveComparison made{.a = hull_of_rows(a), .b = hull_of_rows(b), .cost = {}, .error = {}};
    const LogChanges changes = changes_of(made.a, made.b);
    made.cost = in_units(changes.cost);
    made.error = in_units(changes.error);
    if (!varies(a, made.a) && !varies(b, made.b)) return made;
    made.draws = bootstrap.draws;
    std::vector<double> costs, errors;
    for (std::uint32_t draw = 0; draw < bootstrap.draws; ++draw) {
        const LogChanges drawn = changes_of(drawn_hull(a, draw, bootstrap), drawn_hull(b, draw, bootstrap));
        if (drawn.cost) costs.push_back(drawn.cost->mean);
        if (drawn.error) errors.push_back(drawn.error->mean);
    }
    add_interval(made.cost, std::move(costs), bootstrap.draws);
    add_interval(made.error, std::move(errors), bootstrap.draws);
    return made;
}

}  // namespace strata
