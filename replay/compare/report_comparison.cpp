#include "replay/compare/report_comparison.h"

#include <algorithm>
#include <cmath>

#include "replay/measure/timing.h"
#include "replay/plural.h"
#include "replay/report/variants.h"

namespace strata {
namespace {

std::vector<double> costs_by_repeat(const StoredRow& row, CostKind cost) {
    if (cost == CostKind::bytes_per_pixel) return {std::max(1.0, std::round(row.bytes_per_pixel))};
    std::vector<double> costs = row.repeats_ms;
    if (cost == CostKind::time)
        for (std::size_t i = 0; i < costs.size(); ++i) costs[i] /= row.baseline_repeats_ms[i];
    return costs;
}

/// Streams of two reports do not meet: those of A begin at 0, those of B at 1, in steps of 2.
std::vector<SampledRow> sampled_rows(const StoredReport& report, CostKind cost, std::uint32_t stream) {
    std::vector<SampledRow> sampled;
    for (const StoredRow& row : report.rows) {
        sampled.push_back({.error = row.error, .costs = costs_by_repeat(row, cost), .stream = stream});
        stream += 2;
    }
    return sampled;
}

Result<void> check_equal(std::string_view what, std::string_view a, std::string_view b) {
    if (a == b) return {};
    return fail(Fault::usage, "compare.not_comparable", "the reports cannot be compared: {what} of A is '{a}', of B '{b}'", what,
                a, b);
}

Result<void> check_comparable(const StoredReport& a, const StoredReport& b, CostKind cost) {
    const auto same = check_equal("stage", a.stage, b.stage)
                          .and_then([&] { return check_equal("ranked_by", a.ranked_by.name, b.ranked_by.name); })
                          .and_then([&] { return check_equal("error_at", a.error_at, b.error_at); });
    if (!same || cost != CostKind::time) return same;
    if (a.time_unit.empty() || b.time_unit.empty())
        return fail(Fault::usage, "compare.no_baseline", "{file} has no times relative to a baseline; compare by --cost ms",
                    a.time_unit.empty() ? a.file : b.file);
    return check_equal("time_unit", a.time_unit, b.time_unit);
}

std::vector<ReportDifference> differences_of(const StoredReport& a, const StoredReport& b) {
    std::vector<ReportDifference> differences;
    const auto add = [&](const char* what, std::string of_a, std::string of_b) {
        if (of_a != of_b) differences.push_back({what, std::move(of_a), std::move(of_b)});
    };
    const auto extent = [](const StoredReport& report) { return fmt::format("{} x {}", report.width, report.height); };
    add("device", a.device, b.device);
    add("driver", a.driver, b.driver);
    add("program", a.program, b.program);
    add("capture", fmt::format("{} {}", a.capture_name, a.capture_id), fmt::format("{} {}", b.capture_name, b.capture_id));
    add("frame", fmt::format("{}", a.frame), fmt::format("{}", b.frame));
    add("extent", extent(a), extent(b));
    add("samples", fmt::format("{}", a.samples), fmt::format("{}", b.samples));
    add("truth", a.truth, b.truth);
    add("time unit", a.time_unit, b.time_unit);
    return differences;
}

std::vector<CounterDifference> counter_differences(const StoredRow& a, const StoredRow& b) {
    std::map<std::string, CounterDifference> all;
    for (const auto& [name, value] : a.counters) all[name] = {name, value, 0};
    for (const auto& [name, value] : b.counters) {
        all[name].name = name;
        all[name].b = value;
    }
    std::vector<CounterDifference> differences;
    for (const auto& [name, counter] : all)
        if (counter.a != counter.b) differences.push_back(counter);
    return differences;
}

/// Ratios of B to A, in order; without the draws in which a cost is 0.
std::vector<double> drawn_ratios(const SampledRow& a, const SampledRow& b, const Bootstrap& bootstrap) {
    std::vector<double> ratios;
    for (std::uint32_t draw = 0; draw < bootstrap.draws; ++draw) {
        const double cost_a = drawn_cost(a, draw, bootstrap), cost_b = drawn_cost(b, draw, bootstrap);
        if (cost_a > 0 && cost_b > 0) ratios.push_back(cost_b / cost_a);
    }
    std::ranges::sort(ratios);
    return ratios;
}

/// Ratio and intervals of two rows; the least ratio is for so many rows at once.
void add_ratio(RowComparison& row, const SampledRow& a, const SampledRow& b, std::size_t rows, const Bootstrap& bootstrap) {
    row.cost_a = median_of(a.costs);
    row.cost_b = median_of(b.costs);
    if (!(row.cost_a > 0 && row.cost_b > 0)) return;
    row.ratio = row.cost_b / row.cost_a;
    const std::size_t repeats = std::min(a.costs.size(), b.costs.size());
    if (repeats < fewest_repeats_of_interval) return;
    const std::vector<double> ratios = drawn_ratios(a, b, bootstrap);
    if (ratios.empty()) return;
    row.interval = middle_of(ratios);
    if (repeats >= fewest_repeats_of_row) row.least_ratio = quantile(ratios, .025 / double(rows));
}

const StoredRow* row_in(const StoredReport& report, const StoredRow& like) {
    const auto found = std::ranges::find_if(
        report.rows, [&](const StoredRow& row) { return row.technique == like.technique && row.settings == like.settings; });
    return found == report.rows.end() ? nullptr : &*found;
}

std::vector<std::string> only_in(const StoredReport& report, const StoredReport& other) {
    std::vector<std::string> only;
    for (const StoredRow& row : report.rows)
        if (!row_in(other, row)) only.push_back(short_label(row));
    return only;
}

/// The errors of a hull: "0.01 % to 2 %", "0.01 % alone".
std::string range_of_errors(const std::vector<HullPoint>& hull, const RankingError& error) {
    if (hull.empty()) return "no row with a cost above 0";
    const Interval range = errors_of(hull);
    const std::string low = error.text(std::exp(range.low));
    return hull.size() == 1 ? low + " alone" : fmt::format("{} to {}", low, error.text(std::exp(range.high)));
}

/// The first row of a curve with too few repeats for an interval, or null.
const StoredRow* row_of_few_repeats(const ReportComparison& made) {
    if (made.cost == CostKind::bytes_per_pixel) return nullptr;
    for (const auto& [hull, report] : {std::pair(&made.curves.a, &made.a), std::pair(&made.curves.b, &made.b)})
        for (const HullPoint& corner : *hull)
            if (report->rows[corner.point].repeats_ms.size() < fewest_repeats_of_interval) return &report->rows[corner.point];
    return nullptr;
}

Result<void> check_rows(const ReportComparison& made, double limit) {
    const bool is_memory = made.cost == CostKind::bytes_per_pixel;  // which is known exactly
    std::size_t grown = 0;
    const RowComparison* worst = nullptr;
    for (const RowComparison& row : made.rows) {
        if (!row.ratio || !(*row.ratio > 1 + limit) || !(is_memory || (row.least_ratio && *row.least_ratio > 1))) continue;
        ++grown;
        if (!worst || *row.ratio > *worst->ratio) worst = &row;
    }
    if (!worst) return {};
    return fail(Fault::over_tolerance, "compare.row_grew",
                "{rows} of B cost over {limit} more than in A; the worst, {row}, costs {change}", plural(grown, "row"),
                fmt::format("{:.3g} %", 100 * limit), short_label(*worst), change_text(*worst->ratio));
}

}  // namespace

std::string_view name(CostKind cost) { return cost == CostKind::ms ? "ms" : cost == CostKind::time ? "time" : "memory"; }

Result<ReportComparison> compare_reports(StoredReport a, StoredReport b, CostKind cost, const Bootstrap& bootstrap) {
    if (const auto fits = check_comparable(a, b, cost); !fits) return fits.error();
    const std::vector<SampledRow> sampled_a = sampled_rows(a, cost, 0), sampled_b = sampled_rows(b, cost, 1);
    ReportComparison made{.cost = cost,
                          .differences = differences_of(a, b),
                          .curves = compare_curves(sampled_a, sampled_b, bootstrap),
                          .only_a = only_in(a, b),
                          .only_b = only_in(b, a)};
    const std::size_t in_both = a.rows.size() - made.only_a.size();
    for (const StoredRow& row_a : a.rows) {
        const StoredRow* row_b = row_in(b, row_a);
        if (!row_b) continue;
        RowComparison& row = made.rows.emplace_back(RowComparison{.technique = row_a.technique,
                                                                  .settings = row_a.settings,
                                                                  .error_a = row_a.error,
                                                                  .error_b = row_b->error,
                                                                  .bytes_per_pixel_a = row_a.bytes_per_pixel,
                                                                  .bytes_per_pixel_b = row_b->bytes_per_pixel,
                                                                  .counters = counter_differences(row_a, *row_b)});
        const auto place_a = std::size_t(&row_a - a.rows.data()), place_b = std::size_t(row_b - b.rows.data());
        add_ratio(row, sampled_a[place_a], sampled_b[place_b], in_both, bootstrap);
    }
    made.a = std::move(a);
    made.b = std::move(b);
    return made;
}

Result<void> check_overlap(const ReportComparison& made) {
    if (made.curves.cost) return {};
    return fail(
        Fault::usage, "compare.no_overlap",
        "the cheapest rows of the reports have no range of errors in common: A has {errors_a}, B {errors_b}; report rows whose "
        "errors overlap (--techniques, --sweep)",
        range_of_errors(made.curves.a, made.a.ranked_by), range_of_errors(made.curves.b, made.b.ranked_by));
}

Result<void> check_growth(const ReportComparison& made, double limit) {
    if (!made.only_a.empty())
        return fail(Fault::over_tolerance, "compare.rows_gone", "{rows} of A are not ranked in B: {names}",
                    plural(made.only_a.size(), "row"), first_of(made.only_a));
    if (const StoredRow* row = row_of_few_repeats(made))
        return fail(
            Fault::usage, "compare.few_repeats",
            "--fail-above needs {least} timed repeats of each row of the curves, and {row} has {repeats}; report again with "
            "--repeats {enough}",
            fewest_repeats_of_interval, short_label(*row), row->repeats_ms.size(), fewest_repeats_of_row);
    const std::optional<Change>& change = made.curves.cost;
    const bool is_memory = made.cost == CostKind::bytes_per_pixel;
    const bool is_surely_more = is_memory || (change && change->interval && change->interval->low > 1);
    if (!change || !(change->ratio > 1 + limit) || !is_surely_more) return check_rows(made, limit);
    return fail(Fault::over_tolerance, "compare.grew", "at equal error B costs {change} than A{interval}; the limit is {limit}",
                change_text(change->ratio), interval_note(*change), fmt::format("{:.3g} %", 100 * limit));
}

std::size_t rows_not_judged(const ReportComparison& made) {
    if (made.cost == CostKind::bytes_per_pixel) return 0;
    return std::size_t(std::ranges::count_if(made.rows, [](const RowComparison& row) { return !row.least_ratio; }));
}

bool has_row_of_few_repeats(const ReportComparison& made) { return row_of_few_repeats(made) != nullptr; }

std::string change_text(double ratio) {
    return ratio < 1 ? fmt::format("{:.1f} % less", 100 * (1 - ratio)) : fmt::format("{:.1f} % more", 100 * (ratio - 1));
}

std::string interval_note(const Change& change) {
    return change.interval ? fmt::format(" (95 % interval {})", interval_text(*change.interval)) : "";
}

std::string interval_text(const Interval& of_ratio) {
    if (of_ratio.low < 1 && of_ratio.high > 1)
        return fmt::format("{} to {}", change_text(of_ratio.low), change_text(of_ratio.high));
    const double low = 100 * std::abs(of_ratio.low - 1), high = 100 * std::abs(of_ratio.high - 1);
    return fmt::format("{:.1f} to {:.1f} %", std::min(low, high), std::max(low, high));
}

}  // namespace strata
