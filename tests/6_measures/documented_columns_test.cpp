// The tables of columns in README.md and docs/tables.md are what the columns say of themselves.
#include <algorithm>
#include <fstream>
#include <regex>

#include <gtest/gtest.h>

#include "passes/registry.h"
#include "passes/technique.h"
#include "replay/bench/bench.h"
#include "replay/bench/device_bench.h"
#include "replay/bench/published_tables.h"
#include "replay/compare/report_comparison.h"
#include "replay/difference/comparison.h"
#include "replay/isa/isa_columns.h"
#include "replay/probe/probe_columns.h"
#include "replay/report/hard_cases.h"
#include "replay/report/needs.h"
#include "replay/report/report_columns.h"
#include "replay/spectra/spectra.h"
#include "tests/support/accept.h"
#include "tests/support/file_text.h"

namespace strata {
namespace {

const std::filesystem::path source = STRATA_SOURCE_DIR;

/// A report of a stage that makes radiance, with everything that may be measured.
Report whole_report() {
    Measurement row{.technique = "transparency/weighted"};
    row.accuracy.technique_errors = {{"relative rmse", "", 0},
                                     {"bias", "radiance", 0},
                                     {"P99", "relative", 0},
                                     {"over 10 %", "", 0},
                                     {display_rmse, "of white", 0, true},
                                     {"over 5/255", "%", 0, true}};
    row.accuracy.touched = {{display_rmse, "of white", 0}};
    row.accuracy.touched_share = .5;
    row.accuracy.flip = 0;
    row.flicker = row.coverage_flicker = 0;
    return {.time_unit = "transparency/alpha_blend", .rows = {row}};
}

/// The errors that judges of stages name in their sources, {"name", "unit", ...}. Units differ between stages.
std::vector<Metric> metrics_of_judges() {
    std::vector<Metric> metrics;
    static const std::regex written("\\{\"([A-Za-z][^\"]*)\", \"[^\"]*\",");
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source / "passes")) {
        if (entry.path().filename() != "judge.cpp") continue;
        const std::string text = file_text(entry.path());
        for (std::sregex_iterator found(text.begin(), text.end(), written), none; found != none; ++found)
            if (std::ranges::count(metrics, (*found)[1].str(), &Metric::name) == 0) metrics.push_back({(*found)[1], "", 0});
    }
    std::ranges::sort(metrics, {}, &Metric::name);
    return metrics;
}

/// The columns of these errors.
Sheet sheet_of_metrics(const std::vector<Metric>& metrics) {
    Measurement row{.technique = "transparency/weighted"};
    row.accuracy.technique_errors = metrics;
    Sheet sheet = sheet_of(Report{.rows = {row}});
    std::erase_if(sheet.columns, [&](const Described& is) { return std::ranges::count(metrics, is.key, &Metric::name) == 0; });
    for (Described& is : sheet.columns) is.shown = in_files;
    return sheet;
}

std::string section(const std::string& heading, const std::string& about, const Sheet& sheet) {
    return fmt::format("## {}\n\n{}\n\n{}\n", heading, about, columns_markdown(sheet, DocumentedBy::key));
}

std::string whole_document() {
    std::string text =
        "# Columns\n\nEvery verb that prints a table takes `--csv` and `--json`; `-o FILE` of `report`, `compare`, `bench` "
        "and `spectra` follows "
        "the file's ending\n(.json, .csv, .md, .txt). A key is the same in CSV and JSON unless the table says otherwise; a time "
        "with a spread has two columns of CSV,\n`KEY` and `KEY_mad`, and an object of JSON with `median`, `mad`, `low`, `high` "
        "and "
        "`repeats`. What was not measured has no key in JSON and an\nempty field in CSV; what could not be determined is `null`; "
        "NaN and infinities are \"nan\", \"inf\" and \"-inf\". Every document of JSON has\n`schema`, `schema_version`, `date` "
        "(UTC; "
        "`SOURCE_DATE_EPOCH` fixes it), `program`, and `device`, `capture_id`, `capture_name`, `extent`,\n`samples` where it is "
        "of "
        "one. This file is written by a test from the same descriptions as the tables.\n\n";
    text +=
        section("strata report",
                "A row for each technique and its settings. JSON also has `technique_error`, `touched_error` and `stage_error` "
                "(`metric`, `unit`, `value`), `counters`, the worst texel,\n`steps` with their `ms`, and the times of the "
                "repeats: `repeats_ms` of the "
                "stage, `baseline_repeats_ms` of the baseline in the same repeats. In CSV the errors are columns by their\n"
                "names.",
                sheet_of(whole_report()));
    text += section("strata report: errors of stages",
                    "In JSON the `metric` of `technique_error` and `stage_error`, with its unit; in CSV columns by these names.",
                    sheet_of_metrics(metrics_of_judges()));
    text +=
        section("strata report of several captures: pooled", "CSV has these rows below those of the captures.", sheet_of(Pool()));
    text += section(
        "strata compare",
        "A row for each row of both reports; with `--cost time` or `bytes_per_pixel` the keys `ms_a` and `ms_b` begin with "
        "that name.\nIn JSON `rows`, with the `counters` that differ. JSON also has `at_equal_error` and `at_equal_cost` "
        "(`ratio` of B to A, its 95 %\n`interval`, the range that it is `over`), both reports and their curves.",
        sheet_of(ReportComparison()));
    text += section("strata report --hard-cases", "A row for each case of each technique; in JSON `cases` of `rows`.",
                    sheet_of(HardCaseReport()));
    text += section("strata report --needs: images and buffers",
                    "A row for each, and for each step that the frame does without; in JSON `products` of `frames`.",
                    sheet_of(Needs()));
    text += section("strata report --needs: stages", "In JSON `stages` of `frames`; not in CSV.", sheet_of_stages(Needs()));
    text += section("strata bench", "A row for each ratio. JSON also has `steps`, `extent` and the `counters` of both variants.",
                    sheet_of(Bench()));
    text +=
        section("strata bench --tables",
                "A row for each cell of each table, column by column; in JSON `rows` of `tables`, which also have `technique`, "
                "`title`, `source`,\n`derivation`, `note`, `scene`, `frame`, `extent`, `samples`, `witness` and `variants` "
                "(`row`, `variant`, `against`, `stage_bytes`, `counters`). CSV\nbegins with `technique`, `table` and `scene`.",
                sheet_of(MeasuredTable()));
    text += section("strata bench device", "A row for each of the slowest steps; in JSON `steps`.", sheet_of(DeviceBench()));
    text += section("strata spectra", "A row for each mode that was found; in JSON `modes`.", sheet_of(SpectraReport()));
    text += section("strata isa: programs", "In JSON `programs` of `gpus`, with `occupancy`.", programs_of(IsaOfGpu()));
    text += section("strata isa: steps", "In JSON `steps` of `gpus`.", isa_steps_of(IsaOfGpu()));
    text += section("strata isa without a capture", "A row for each GPU; in JSON `gpus`.", sheet_of(gpu_models()));
    text += section("strata probe: fragments", "Colors are arrays in JSON.", fragments_of(Probe()));
    text += section("strata probe: variants", "In JSON `curves`.", variants_of(std::span<const ProbeCurve* const>()));
    text += section("strata diff", "A row for each image of each pass; in JSON `images` of `passes` of `frames`.",
                    sheet_of(Comparison()));
    text.pop_back();
    return text;
}

/// Fails where the file does not have this text between the two, and with STRATA_ACCEPT=1 puts it there.
void expect_documented(const std::filesystem::path& file, const std::string& text, const std::string& begin,
                       const std::string& end) {
    const std::string now = file_text(file);
    const std::size_t from = now.find(begin), first = from + begin.size();
    const std::size_t last = end.empty() ? now.size() : now.find(end, from);
    ASSERT_TRUE(from != now.npos && last != now.npos) << file << " lacks " << begin << " or " << end;
    if (now.substr(first, last - first) == text) return;
    ADD_FAILURE() << file << " does not say what the columns say. Accept it with\n"
                  << command_that_accepts() << "\nIt should say:\n"
                  << text;
    if (accepting()) std::ofstream(file, std::ios::binary) << now.substr(0, first) << text << now.substr(last);
}

TEST(Documents, HaveASentenceForEveryErrorThatAJudgeNames) {
    const std::vector<Metric> metrics = metrics_of_judges();
    EXPECT_GE(metrics.size(), 44u);
    const Sheet sheet = sheet_of_metrics(metrics);
    EXPECT_EQ(sheet.columns.size(), metrics.size());
    for (const Described& is : sheet.columns) EXPECT_FALSE(is.help.empty()) << is.key;
}

TEST(Documents, OfColumnsSayWhatTheColumnsSay) {
    expect_documented(source / "README.md", columns_markdown(sheet_of(whole_report()), DocumentedBy::title),
                      "<!-- columns of strata report -->\n", "<!-- end of columns -->");
    expect_documented(source / "docs/tables.md", whole_document(), "", "");
}

}  // namespace
}  // namespace strata
