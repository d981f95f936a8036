// strata compare: two reports that the tool wrote, beside each other.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/7_tool/process.h"
#include "tests/support/file_text.h"

namespace strata {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// A report of three techniques and the baseline, which errs on these panes.
json made_report() {
    EXPECT_EQ(strata("record interpenetrating_panes -o panes.strata --size 64x36").code, 0);
    const Finished made = strata("report panes.strata --techniques moments,k_buffer,weighted --repeats 2 -o made.json");
    EXPECT_EQ(made.code, 0) << made.err;
    return json::parse(file_text(folder() / "made.json"));
}

void write_report(const char* file, const json& report) { std::ofstream(folder() / file) << report.dump(); }

/// Times that are known: each row takes half as long as the more accurate one above it, times the factor.
json with_times(json report, double factor) {
    double ms = 16 * factor;
    for (json& row : report["rows"]) {
        row["repeats_ms"] = {ms, 1.01 * ms, .99 * ms, ms, 1.02 * ms, .98 * ms, ms};
        row["baseline_repeats_ms"] = {2, 2, 2, 2, 2, 2, 2};
        ms /= 2;
    }
    return report;
}

TEST(Compare, ReadsWhatReportWrites) {
    const json report = made_report();
    for (const json& row : report["rows"]) {
        EXPECT_EQ(row["repeats_ms"].size(), row["stage_ms"]["repeats"]);
        EXPECT_EQ(row["baseline_repeats_ms"].size(), row["stage_ms"]["repeats"]);
        EXPECT_EQ(row["repeats_ms"][0].get<double>() + row["repeats_ms"][1].get<double>(),
                  2 * row["stage_ms"]["median"].get<double>());
        EXPECT_TRUE(row.contains("ranking_error"));
        double multiples = 0;
        for (const std::size_t i : {0u, 1u})
            multiples += row["repeats_ms"][i].get<double>() / row["baseline_repeats_ms"][i].get<double>();
        EXPECT_NEAR(multiples, 2 * row["time"]["median"].get<double>(), 1e-12 * multiples) << "rounding";
    }
    const Finished same = strata("compare made.json made.json --cost memory");
    EXPECT_THAT(same.out, AllOf(StartsWith("transparency of made.json (A) and made.json (B)"), HasSubstr("\n   weighted ")));
}

TEST(Compare, SaysWhatBSavesAndFailsWhereItCostsTooMuch) {
    const json report = made_report();
    write_report("a.json", with_times(report, 1));
    write_report("b.json", with_times(report, .8));
    const Finished less = strata("compare a.json b.json --fail-above 5%");
    EXPECT_EQ(less.code, 0) << less.err;
    EXPECT_THAT(less.out, AllOf(HasSubstr("at equal error B takes 20.0 % less time"), HasSubstr("\n<  weighted ")));
    EXPECT_THAT(strata("-v compare b.json a.json --fail-above 5%"), Refuses(1, "compare.grew", "change=\"25.0 % more\""));
    EXPECT_EQ(strata("compare b.json a.json --fail-above 30%").code, 0);
    EXPECT_THAT(strata("-v compare b.json a.json --fail-above 5"), Refuses(2, "options.share_above_1"));
    EXPECT_THAT(strata("-v compare made.json a.json --fail-above -1%"), Refuses(2, "options.malformed"));

    const json document = json::parse(strata("compare a.json b.json --json").out);
    EXPECT_EQ(document["schema"], "strata.report_comparison");
    EXPECT_NEAR(document["at_equal_error"]["ratio"].get<double>(), .8, 1e-12);
    EXPECT_EQ(document["at_equal_error"]["interval"].size(), 2u);
    EXPECT_EQ(document["rows"].size(), 4u);
    EXPECT_THAT(strata("compare a.json b.json --csv").out, StartsWith("technique,settings,error_a,"));
    EXPECT_EQ(strata("compare a.json b.json -o made.md").out, "");
    EXPECT_THAT(file_text(folder() / "made.md"), HasSubstr("| transparency and settings |"));
    EXPECT_THAT(strata("-v compare a.json b.json -o made.png"), Refuses(2, "output.unknown_ending"));
    EXPECT_EQ(strata("compare a.json b.json -o a.json").code, 2) << "an input is not replaced";
}

TEST(Compare, PrintsTheRowsAlsoWhereNoErrorIsInCommon) {
    const json report = with_times(made_report(), 1);
    json one = report;
    one["rows"].erase(one["rows"].begin() + 1, one["rows"].end());
    write_report("a.json", report);
    write_report("b.json", one);
    const Finished refused = strata("-v compare a.json b.json");
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err, HasSubstr("strata: compare.no_overlap: "));
    EXPECT_THAT(refused.out, AllOf(HasSubstr("\nonly in A: "), HasSubstr("\n   moments ")));
    one["stage"] = "shadows";
    write_report("b.json", one);
    EXPECT_THAT(strata("-v compare a.json b.json"), Refuses(2, "compare.not_comparable", "what=stage a=transparency b=shadows"));
    EXPECT_THAT(strata("-v compare a.json panes.strata"), Refuses(3, "compare.not_json", "file=panes.strata"));
}

}  // namespace
}  // namespace strata
