// Two reports beside each other: what differs between them, what B saves at equal error, and every row that both have. No device.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "replay/compare/curve_comparison.h"
#include "replay/compare/stored_report.h"
#include "replay/tables/sheet.h"

namespace strata {

/// The cost of a row: milliseconds of its stage; these as multiples of the baseline's, repeat by repeat, so that what slows both
/// cancels; or memory, of which less than a byte per pixel counts as one.
enum class CostKind { ms, time, bytes_per_pixel };
std::string_view name(CostKind);

/// A property that is not the same in both reports: "driver".
struct ReportDifference {
    std::string what, a, b;
};

/// A counter that is not the same in both; one that a side lacks counts 0.
struct CounterDifference {
    std::string name;
    std::uint64_t a = 0, b = 0;
};

/// A ranked row of both reports: equal technique, equal settings.
struct RowComparison {
    std::string technique, settings;
    double error_a = 0, error_b = 0;
    double cost_a = 0, cost_b = 0;
    double bytes_per_pixel_a = 0, bytes_per_pixel_b = 0;
    std::optional<double> ratio;  ///< cost_b / cost_a; none where one of them is 0
    /// 95 % interval of the ratio; none of memory and of rows with fewer repeats than fewest_repeats_of_interval.
    std::optional<Interval> interval;
    /// The lower end of an interval for all rows of the comparison at once: of 100 equal rows 5 have a 95 % interval without 1
    /// (Bonferroni). None of fewer repeats than fewest_repeats_of_row.
    std::optional<double> least_ratio;
    std::vector<CounterDifference> counters;

    /// True where the interval does not contain 1.
    bool is_told_apart() const { return interval && (interval->low > 1 || interval->high < 1); }
};

/// With two repeats a 95 % interval of the curves holds the true ratio in 75 of 100 comparisons, with three to 15 in 98 or 99
/// (normal times, 1,000 trials).
inline constexpr std::size_t fewest_repeats_of_interval = 3;
/// One of 97 equal rows seems to have grown by its least_ratio in 99 % of comparisons at 3 repeats, in 34 % at 5, in 0 to 6 % at
/// 7 (normal and exponential times, 3,000 trials).
inline constexpr std::size_t fewest_repeats_of_row = 7;

struct ReportComparison {
    StoredReport a, b;
    CostKind cost = CostKind::ms;
    std::vector<ReportDifference> differences;
    CurveComparison curves;
    std::vector<RowComparison> rows;  ///< in the order of A
    std::vector<std::string> only_a, only_b;
    std::string date = {};  ///< utc_date(); the caller's
};
/// Fails (usage) for reports of different stages, rankings or places of the error; in units of `time` also of different
/// baselines.
Result<ReportComparison> compare_reports(StoredReport a, StoredReport b, CostKind, const Bootstrap& = {});

/// Fails (usage) where the curves have no range of errors in common.
Result<void> check_overlap(const ReportComparison&);
/// Fails (over tolerance) where B lacks a row of A, or where B costs more at equal error by more than the limit, a share, and the
/// interval says that it costs more at all; or where a row does by its least_ratio. Fails (usage) where a row of the curves has
/// fewer repeats than fewest_repeats_of_interval.
Result<void> check_growth(const ReportComparison&, double limit);
/// Rows of both that check_growth() cannot judge one by one: timed fewer than fewest_repeats_of_row times.
std::size_t rows_not_judged(const ReportComparison&);
/// True where a corner of a curve is a row with fewer repeats than fewest_repeats_of_interval.
bool has_row_of_few_repeats(const ReportComparison&);

/// "12.3 % less", "4.0 % more".
std::string change_text(double ratio);
/// "10.1 to 14.4 %", or "2.1 % less to 3.0 % more".
std::string interval_text(const Interval& of_ratio);
/// " (95 % interval 10.1 to 14.4 %)", or nothing without one.
std::string interval_note(const Change&);

Sheet sheet_of(const ReportComparison&);
Page page_of(const ReportComparison&);
std::string as_text(const ReportComparison&);
std::string as_json(const ReportComparison&);
std::string as_csv(const ReportComparison&);

}  // namespace strata
