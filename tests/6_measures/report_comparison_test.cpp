// Two reports beside each other: what differs, row by row, and when B has grown.
#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "replay/compare/report_comparison.h"
#include "tests/6_measures/stored_reports.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::vector<double> times(double ms) {
    std::vector<double> all;
    for (const double share : {1., 1.01, .99, 1.02, .98, 1., 1.}) all.push_back(ms * share);
    return all;
}

/// Four rows; each costs `factor` times as much, the first `first` times that.
Report four_rows(double factor, double first = 1) {
    return report_with({{"transparency/voxel", .001, times(8 * factor * first)},
                        {"transparency/moments", .005, times(3 * factor)},
                        {"transparency/k_buffer", .02, times(1.5 * factor), 12},
                        {"transparency/weighted", .1, times(factor)}});
}

ReportComparison compared(const Report& a, const Report& b, CostKind cost = CostKind::ms) {
    return *compare_reports(stored(a), stored(b), cost);
}

TEST(ReportComparison, SaysWhatBSavesAtEqualErrorAndHowMuchLessItErrs) {
    const ReportComparison made = compared(four_rows(1), four_rows(.8));
    EXPECT_NEAR(made.curves.cost->ratio, .8, 1e-12);
    EXPECT_LT(made.curves.error->ratio, 1);
    EXPECT_GT(made.curves.cost->interval->low, .77);
    EXPECT_LT(made.curves.cost->interval->high, .83);
    EXPECT_THAT(as_text(made), AllOf(HasSubstr("at equal error B takes 20.0 % less time (95 % interval "),
                                     HasSubstr("over errors of 0.1 % to 10 %"), HasSubstr("\nat equal time B's error is "),
                                     Not(HasSubstr("timed once")), HasSubstr("see --cost time"), Not(HasSubstr("are left out"))));
}

TEST(ReportComparison, HasEachRowOfBothAndNamesTheOthers) {
    Report b = four_rows(1, 1.5);
    b.rows[3].technique = "transparency/wavelet";
    b.rows[2].counters[0].value = 0;
    b.rows[1].accuracy.technique_errors[0].value = .01;
    const ReportComparison made = compared(four_rows(1), b);
    EXPECT_THAT(made.only_a, ElementsAre("weighted"));
    EXPECT_THAT(made.only_b, ElementsAre("wavelet"));
    ASSERT_EQ(made.rows.size(), 3u);
    EXPECT_NEAR(*made.rows[0].ratio, 1.5, 1e-12);
    EXPECT_TRUE(made.rows[0].is_told_apart());
    EXPECT_FALSE(made.rows[1].is_told_apart());
    EXPECT_EQ(made.rows[1].error_b, .01);
    const std::string text = as_text(made);
    EXPECT_THAT(text, AllOf(HasSubstr("\n>  voxel "), HasSubstr("only in A: weighted\n"), HasSubstr("only in B: wavelet\n"),
                            HasSubstr("   k_buffer: overflowed 12 -> 0\n")));
    const auto json = nlohmann::json::parse(as_json(made));
    EXPECT_EQ(json["schema"], "strata.report_comparison");
    EXPECT_EQ(json["rows"][0]["is_told_apart"], true);
    EXPECT_EQ(json["rows"][1]["error_ratio"], 2.0);
    EXPECT_EQ(json["rows"][2]["counters"]["overflowed"]["a"], 12);
    EXPECT_EQ(json["a"]["only_here"][0], "weighted");
    EXPECT_EQ(json["curve_a"].size(), 4u);
    EXPECT_THAT(as_csv(made), HasSubstr("technique,settings,error_a,error_b,error_ratio,ms_a,ms_b,ratio,"));
}

TEST(ReportComparison, SaysFirstWhatDiffersBetweenTheReports) {
    Report b = four_rows(1);
    b.device.driver_version = "2.0";
    b.capture_id = "another";
    const ReportComparison made = compared(four_rows(1), b);
    ASSERT_EQ(made.differences.size(), 2u);
    EXPECT_EQ(made.differences[0].what, "driver");
    EXPECT_THAT(as_text(made), AllOf(HasSubstr("driver of A: its driver 1.2, of B: its driver 2.0\n"),
                                     HasSubstr("\n! the reports are of different frames")));
}

TEST(ReportComparison, OfOtherStagesRankingsOrPlacesIsRefused) {
    const StoredReport a = stored(four_rows(1));
    StoredReport b = a;
    b.stage = "shadows";
    EXPECT_THAT(compare_reports(a, b, CostKind::ms), FailsWith("compare.not_comparable", Field("what", "stage")));
    b = a;
    b.ranked_by.name = "rmse";
    EXPECT_THAT(compare_reports(a, b, CostKind::ms), FailsWith("compare.not_comparable", Field("what", "ranked_by")));
    b = a;
    b.error_at = "picture";
    EXPECT_THAT(compare_reports(a, b, CostKind::ms), FailsWith("compare.not_comparable", Field("what", "error_at")));
    b = a;
    b.time_unit = "transparency/weighted";
    EXPECT_TRUE(compare_reports(a, b, CostKind::ms));
    EXPECT_THAT(compare_reports(a, b, CostKind::time), FailsWith("compare.not_comparable", Field("what", "time_unit")));
    b.time_unit.clear();
    EXPECT_THAT(compare_reports(a, b, CostKind::time), FailsWith("compare.no_baseline"));
}

TEST(ReportComparison, InMultiplesOfTheBaselineDoesNotSeeThatTheMachineIsSlower) {
    Report b = four_rows(1.3);
    for (Measurement& row : b.rows)
        for (double& ms : row.baseline_repeats_ms) ms *= 1.3;
    EXPECT_NEAR(compared(four_rows(1), b).curves.cost->ratio, 1.3, 1e-12);
    EXPECT_NEAR(compared(four_rows(1), b, CostKind::time).curves.cost->ratio, 1, 1e-12);
}

TEST(ReportComparison, OfMemoryHasNoInterval) {
    Report a = four_rows(1), b = four_rows(1);
    for (std::size_t i = 0; i < 4; ++i) {
        a.rows[i].bytes_per_pixel = 64 >> i;
        b.rows[i].bytes_per_pixel = 128 >> i;
    }
    const ReportComparison made = compared(a, b, CostKind::bytes_per_pixel);
    EXPECT_FALSE(made.curves.cost->interval);
    EXPECT_NEAR(made.curves.cost->ratio, 2, 1e-12);
    EXPECT_THAT(as_text(made), HasSubstr("at equal error B takes 100.0 % more memory, over errors"));
    EXPECT_THAT(check_growth(made, .05), FailsWith("compare.grew"));
    b.rows[3].bytes_per_pixel = .001;  // a counter, which is no cost
    EXPECT_EQ(compared(a, b, CostKind::bytes_per_pixel).rows[3].cost_b, 1);
}

TEST(ReportComparison, WithoutErrorsInCommonSaysBothRangesAndStillHasRows) {
    Report b = four_rows(1);
    b.rows.resize(1);
    const ReportComparison made = compared(four_rows(1), b);
    EXPECT_THAT(check_overlap(made),
                FailsWith("compare.no_overlap", Field("errors_a", "0.1 % to 10 %"), Field("errors_b", "0.1 % alone")));
    EXPECT_THAT(as_text(made), AllOf(HasSubstr("have no range of errors in common"), HasSubstr("\n   voxel ")));
    EXPECT_TRUE(nlohmann::json::parse(as_json(made))["at_equal_error"].is_null());
    EXPECT_TRUE(check_overlap(compared(four_rows(1), four_rows(2))));
}

TEST(ReportComparison, OfRowsTimedOnceSaysThatTheyHaveNoSpread) {
    Report b = four_rows(1);
    for (const std::size_t repeats : {2u, 1u}) {
        b.rows[1].repeats_ms.resize(repeats);
        b.rows[1].baseline_repeats_ms.resize(repeats);
        const ReportComparison made = compared(four_rows(1), b);
        EXPECT_THAT(as_text(made), HasSubstr("rows timed once have no spread"));
        EXPECT_FALSE(made.rows[1].interval);
        EXPECT_THAT(check_growth(made, .05),
                    FailsWith("compare.few_repeats", Field("row", "moments"), Field("repeats", repeats)));
    }
}

TEST(Growth, FailsWhereTheLimitIsExceededByMoreThanTheSpread) {
    EXPECT_THAT(check_growth(compared(four_rows(1), four_rows(1.1)), .05),
                FailsWith("compare.grew", Field("change", "10.0 % more")));
    EXPECT_TRUE(check_growth(compared(four_rows(1), four_rows(1.1)), .15));
    EXPECT_TRUE(check_growth(compared(four_rows(1.1), four_rows(1)), .05));
    EXPECT_TRUE(check_growth(compared(four_rows(1), four_rows(1.002)), .001)) << "within the spread";
}

TEST(Growth, OfOneRowFailsThoughTheCurveDoesNot) {
    Report a = four_rows(1), b = four_rows(1);
    for (Report* report : {&a, &b})  // slower and less accurate than others: no corner of the curve
        report->rows.push_back(report_with({{"transparency/wavelet", .05, times(report == &a ? 10 : 13)}}).rows[0]);
    const ReportComparison made = compared(a, b);
    EXPECT_NEAR(made.curves.cost->ratio, 1, 1e-12);
    EXPECT_THAT(check_growth(made, .05),
                FailsWith("compare.row_grew", Field("rows", "1 row"), Field("row", "wavelet"), Field("change", "30.0 % more")));
    EXPECT_EQ(rows_not_judged(made), 0u);
    for (Report* report : {&a, &b}) {
        report->rows[4].repeats_ms.resize(fewest_repeats_of_row - 1);
        report->rows[4].baseline_repeats_ms.resize(fewest_repeats_of_row - 1);
    }
    EXPECT_TRUE(check_growth(compared(a, b), .05)) << "too few repeats for one row among several";
    EXPECT_EQ(rows_not_judged(compared(a, b)), 1u);
}

/// 12 rows timed seven times, with deviations of 10 %.
Report noisy_rows(std::mt19937_64& random) {
    const auto unit = [&] { return (double(random() >> 11) + .5) * 0x1p-53; };
    std::vector<TimedRow> rows;
    for (int i = 0; i < 12; ++i) {
        TimedRow& row = rows.emplace_back(TimedRow{fmt::format("transparency/row_{}", i), .001 * (i + 1), {}});
        for (int repeat = 0; repeat < 7; ++repeat) {
            const double normal = std::sqrt(-2 * std::log(unit())) * std::cos(2 * std::numbers::pi * unit());
            row.repeats_ms.push_back(10. / (i + 1) * (1 + .1 * normal));
        }
    }
    return report_with(rows);
}

TEST(Growth, FailsInAtMost5Of100ComparisonsOfTheSame) {
    std::mt19937_64 random(1);
    int failed = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const StoredReport a = stored(noisy_rows(random)), b = stored(noisy_rows(random));
        if (!check_growth(*compare_reports(a, b, CostKind::ms, {.draws = 1000}), .02)) ++failed;
    }
    EXPECT_LE(failed, 5);
}

TEST(Changes, AreWords) {
    EXPECT_EQ(change_text(.877), "12.3 % less");
    EXPECT_EQ(change_text(1.04), "4.0 % more");
    EXPECT_EQ(interval_text({.856, .899}), "10.1 to 14.4 %");
    EXPECT_EQ(interval_text({1.01, 1.2}), "1.0 to 20.0 %");
    EXPECT_EQ(interval_text({.979, 1.03}), "2.1 % less to 3.0 % more");
}

}  // namespace
}  // namespace strata
