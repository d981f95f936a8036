// Rows as data: what each format makes of the same columns and rows.
#include <cmath>
#include <limits>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "passes/metric.h"
#include "replay/report/report_columns.h"
#include "replay/report/warnings.h"
#include "replay/tables/document.h"
#include "replay/tables/sheet.h"
#include "replay/tables/table.h"

namespace strata {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

struct Measured {
    std::string name, not_supported;
    double error = 0;
    Spread time;
    std::optional<double> flicker;
    CellValue model = Unknown{};
};

/// A column of each kind that formats treat differently; the last is in files alone.
std::vector<Column<Measured>> kinds_of_columns() {
    using Of = Column<Measured>::Of;
    return {
        {{.key = "name", .title = "name", .help = "", .kind = CellKind::text, .shown = in_files},
         [](const Measured& row) { return row.name; },
         Of::every_row},
        {{.key = "error", .title = "relative error", .help = "how wrong it is"}, [](const Measured& row) { return row.error; }},
        {{.key = "time", .title = "time, x baseline", .help = "", .kind = CellKind::ratio},
         [](const Measured& row) { return row.time; }},
        {{.key = "flicker", .title = "flicker", .help = "", .if_any = true},
         [](const Measured& row) { return cell_or_nothing(row.flicker); }},
        {{.key = "model", .title = "model", .help = "", .json = "/implementation/rmse"},
         [](const Measured& row) { return row.model; }},
        {{.key = "not_supported", .title = "", .help = "why not", .kind = CellKind::text, .shown = in_files},
         [](const Measured& row) { return cell_if_any(row.not_supported); },
         Of::every_row}};
}

Sheet sheet_of_rows(std::vector<Measured> rows) {
    return sheet_of<Measured>(kinds_of_columns(), rows, [](const Measured& row) {
        return RowName{"*", row.name, row.not_supported.empty() ? "" : "not supported: " + row.not_supported};
    });
}

const Measured measured_row{.name = "good", .error = .25, .time = {.median = 2, .mad = .125, .repeats = 7}};
const Measured unable_row{.name = "unable", .not_supported = "glass, \"colored\""};

TEST(SheetText, LeavesOutWhatNoRowHasAndShowsTheReasonInsteadOfNumbers) {
    EXPECT_EQ(as_text(sheet_of_rows({measured_row, unable_row})),
              "           relative      time, x\n"
              "              error     baseline  model\n"
              "*  good        0.25  2.00 +-0.12      -\n"
              "*  unable not supported: glass, \"colored\"\n");
    Measured flickers = measured_row;
    flickers.flicker = .5;
    EXPECT_THAT(as_text(sheet_of_rows({measured_row, flickers})), HasSubstr("flicker"));
}

TEST(SheetText, OfOneRunHasNoSpread) {
    Measured once = measured_row;
    once.time.repeats = 1;
    EXPECT_THAT(as_text(sheet_of_rows({once})), Not(HasSubstr("+-")));
}

TEST(SheetText, WrapsHeadsAndKeepsTo120Columns) {
    std::vector<Column<int>> many;
    for (int i = 0; i < 14; ++i)
        many.push_back({{.key = "k", .title = "a title of several words", .help = ""}, [](int row) { return double(row); }});
    const std::vector<int> rows{1, 2};
    const std::string text = as_text(sheet_of<int>(many, rows, [](int) { return RowName{"", std::string(200, 'x')}; }));
    std::istringstream lines(text);
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line); ++count)
        EXPECT_TRUE(line.size() <= 120 || line.find(std::string(200, 'x')) != line.npos) << line;
    EXPECT_EQ(count, 4u + 2 * 2u) << "four lines of heads; each label has a line of its own";
}

TEST(SheetLines, AlignWordsToTheLeftAndNumbersToTheRight) {
    const std::vector<Column<Measured>> columns{
        {{.key = "name", .title = "variant", .help = "", .kind = CellKind::text, .width = 8},
         [](const Measured& row) { return row.name; },
         Column<Measured>::Of::every_row},
        {{.key = "error", .title = "error", .help = "", .digits = "+.2f", .width = 7},
         [](const Measured& row) { return row.error; }}};
    const std::vector rows{measured_row, unable_row};
    EXPECT_EQ(as_lines(sheet_of<Measured>(columns, rows,
                                          [](const Measured& row) {
                                              return RowName{"", "", row.not_supported.empty() ? "" : "not supported"};
                                          })),
              "  variant     error\n"
              "  good        +0.25\n"
              "  unable    not supported\n");
}

TEST(SheetCsv, QuotesTextAndHasASpreadInTwoFields) {
    EXPECT_EQ(as_csv(std::vector{sheet_of_rows({measured_row, unable_row})}),
              "name,error,time,time_mad,flicker,model,not_supported\n"
              "\"good\",0.25,2,0.125,,,\n"
              "\"unable\",,,,,,\"glass, \"\"colored\"\"\"\n");
}

TEST(SheetCsv, OfSeveralSheetsIsOneTableWithTheColumnsOfAll) {
    Sheet first = sheet_of_rows({measured_row});
    first.of_every_row = {{"capture", "a.strata"}};
    const std::vector<Column<int>> others{
        {{.key = "count", .title = "", .help = "", .kind = CellKind::count}, [](int row) { return std::uint64_t(row); }},
        {{.key = "error", .title = "", .help = ""}, [](int) { return .5; }}};
    const std::vector<int> rows{3};
    Sheet second = sheet_of<int>(others, rows, [](int) { return RowName(); });
    second.of_every_row = {{"capture", "pooled"}};
    EXPECT_EQ(as_csv(std::vector{first, second}),
              "capture,name,error,time,time_mad,flicker,model,not_supported,count\n"
              "\"a.strata\",\"good\",0.25,2,0.125,,,,\n"
              "\"pooled\",,0.5,,,,,,3\n");
}

TEST(SheetJson, HasNoKeyForNothingNullForUnknownAndWordsForWhatIsNotFinite) {
    Measured broken = measured_row;
    broken.error = std::nan("");
    broken.time.mad = std::numeric_limits<double>::infinity();
    const auto rows = rows_json(sheet_of_rows({broken, unable_row}));
    EXPECT_EQ(rows[0]["error"], "nan");
    EXPECT_EQ(rows[0]["time"]["mad"], "inf");
    EXPECT_EQ(rows[0]["time"]["repeats"], 7);
    EXPECT_FALSE(rows[0].contains("flicker"));
    EXPECT_TRUE(rows[0]["implementation"]["rmse"].is_null());
    EXPECT_EQ(rows[1].size(), 2u) << "a name and a reason: " << rows[1];
    EXPECT_EQ(cell_json(-std::numeric_limits<double>::infinity()), "-inf");
}

TEST(SheetMarkdown, EscapesWhatWouldEndACell) {
    Measured odd = measured_row;
    odd.name = "a|b*c\nd";
    Sheet sheet = sheet_of_rows({odd, unable_row});
    sheet.heads_labels = "technique";
    EXPECT_EQ(as_markdown(sheet),
              "|  | technique | relative error | time, x baseline | model |\n"
              "|---|---|---:|---:|---:|\n"
              "| \\* | a\\|b\\*c d | 0.25 | 2.00 +-0.12 | - |\n"
              "| \\* | unable | not supported: glass, \"colored\" |\n");
}

TEST(PageMarkdown, FencesTextWithMoreBackticksThanItHas) {
    EXPECT_EQ(as_markdown(Page{"\none\n\ntwo ``` three\n"}), "````\none\n\ntwo ``` three\n````\n");
}

TEST(WindowCell, HasADashForWhatIsMissingAndANumberToSortBy) {
    const Described is{.key = "ms", .title = "milliseconds", .help = "time", .kind = CellKind::median, .short_title = "ms"};
    EXPECT_EQ(window_cell(is, {}).text, "\xe2\x80\x93");
    EXPECT_EQ(window_cell(is, Unknown{}).sort, std::nullopt);
    const WindowCell cell = window_cell(is, Spread{.median = 2, .mad = .5});
    EXPECT_EQ(cell.text, "2 \xc2\xb1 0.5");
    EXPECT_EQ(cell.sort, 2);
    EXPECT_EQ(window_title(is), "ms");
    EXPECT_EQ(window_tooltip(is), "milliseconds: time");
}

TEST(JsonDocument, BeginsWithWhatItIsAndOfWhat) {
    const DeviceInfo device{.name = "a device"};
    const auto json = document({.schema = "strata.some",
                                .date = utc_date(0),
                                .device = &device,
                                .capture_id = "1234",
                                .capture_name = "a.strata",
                                .width = 16,
                                .height = 9,
                                .samples = 4});
    std::vector<std::string> keys;
    for (const auto& item : json.items()) keys.push_back(item.key());
    EXPECT_THAT(keys, ElementsAre("schema", "schema_version", "date", "program", "device", "capture_id", "capture_name", "extent",
                                  "samples"));
    EXPECT_EQ(json["date"], "1970-01-01T00:00:00Z");
    EXPECT_EQ(utc_date(1764208800), "2025-11-27T02:00:00Z");
    EXPECT_THAT(std::string(json["program"]), testing::StartsWith("strata "));
    EXPECT_FALSE(document({.schema = "strata.some"}).contains("device"));
}

/// One row that cannot do the frame: no head without numbers, and its reason in every format.
TEST(ReportSheet, OfOneRowThatIsNotSupportedHasItsReasonInEveryFormat) {
    Report report{.capture_name = "a.strata", .rows = {{.technique = "transparency/weighted"}}};
    report.rows[0].accuracy.not_supported = "glass is colored";
    EXPECT_THAT(as_text(report), HasSubstr("   weighted not supported: glass is colored\n"));
    EXPECT_THAT(as_csv(report), HasSubstr("\"glass is colored\",\n"));
    EXPECT_THAT(as_markdown(page_of(report)), HasSubstr("| weighted | not supported: glass is colored |\n"));
    const auto row = nlohmann::json::parse(as_json(report))["rows"][0];
    EXPECT_EQ(row["not_supported"], "glass is colored");
    EXPECT_EQ(row.size(), 3u) << row;
}

/// A row whose errors over what the stage touches are these, of white and of radiance.
Measurement judged_row(std::string technique, double display, double relative, const Footing& footing) {
    Measurement row{.technique = "transparency/" + std::move(technique)};
    row.accuracy.technique_errors = row.accuracy.touched = {{"relative rmse", "", relative}, {display_rmse, "of white", display}};
    row.accuracy.footing = footing;
    return row;
}

std::vector<std::string> ids_of(const std::vector<Warning>& warnings) {
    std::vector<std::string> ids;
    ids.reserve(warnings.size());
    for (const Warning& warning : warnings) ids.push_back(warning.id);
    return ids;
}

TEST(Warnings, SayWhatErrorsRestOn) {
    const auto of = [](const Footing& footing) { return Report{.rows = {judged_row("weighted", .02, .1, footing)}}; };
    EXPECT_THAT(ids_of(warnings_of(of({.pixels = 1000, .clipped_share = .25, .concentration = .5, .brightest_share = .25}))),
                ElementsAre());
    EXPECT_THAT(ids_of(warnings_of(of({.pixels = 999}))), ElementsAre("few_pixels"));
    const Report rests =
        of({.pixels = 99, .clipped_share = .26, .concentration = .51, .brightest_share = .978, .x = 312, .y = 88});
    const auto warnings = warnings_of(rests);
    EXPECT_THAT(ids_of(warnings), ElementsAre("few_pixels", "one_sample", "clipped", "concentrated"));
    EXPECT_THAT(warnings[0].text, HasSubstr("99 pixels: too few"));
    EXPECT_THAT(warnings[1].text, HasSubstr("(312, 88) has 97.8 %"));
    EXPECT_THAT(warnings[3].text, HasSubstr(": weighted"));
    EXPECT_THAT(as_text(rests), HasSubstr("! relative rmse rests on one sample"));
    EXPECT_EQ(nlohmann::json::parse(as_json(rests))["warnings"].size(), 4u);
    EXPECT_THAT(warnings_of({.rows = {judged_row("weighted", 1e-5, .1, {.pixels = 5000, .concentration = .9})}}), ElementsAre())
        << "what rounding leaves lies somewhere";
}

TEST(Warnings, NameTheRowThatTwoMetricsPlaceFurthestApart) {
    const Footing footing{.pixels = 5000};
    Report report{.rows = {judged_row("weighted", .01, .4, footing), judged_row("k_buffer", .02, .1, footing),
                           judged_row("moments", .03, .2, footing), judged_row("wavelet", .04, .3, footing)}};
    // Three of six pairs are ordered alike: tau = 0.
    const auto warnings = warnings_of(report);
    ASSERT_THAT(ids_of(warnings), ElementsAre("metrics_disagree"));
    EXPECT_THAT(warnings[0].text, HasSubstr("(rank agreement 0.00): weighted is number 1 of 4 by the one and number 4"));
    report.rows[0].has_other_truth = true;
    EXPECT_THAT(warnings_of(report), ElementsAre());
}

TEST(Warnings, AgreementOfRanksIsKendallsTauB) {
    EXPECT_EQ(rank_agreement({1, 2, 3}, {4, 5, 6}), 1);
    EXPECT_EQ(rank_agreement({1, 2, 3}, {6, 5, 4}), -1);
    // By scipy.stats.kendalltau([12, 2, 1, 12, 2], [1, 4, 7, 1, 0]), which has ties in both.
    EXPECT_NEAR(*rank_agreement({12, 2, 1, 12, 2}, {1, 4, 7, 1, 0}), -.47140452079103173, 1e-15);
    EXPECT_FALSE(rank_agreement({1, 1, 1}, {1, 2, 3}));
    EXPECT_FALSE(rank_agreement({1}, {2}));
}

TEST(Warnings, FewerThanAHundredPixelsHaveNoAnswer) {
    Report report{.question = {.error = .05}, .rows = {judged_row("weighted", .02, .1, {.pixels = 99})}};
    EXPECT_TRUE(is_unanswered(report));
    EXPECT_THAT(as_text(report), HasSubstr("answer: none; the stage changes fewer than 100 pixels"));
    EXPECT_TRUE(nlohmann::json::parse(as_json(report))["answer"]["recommended"].is_null());
    report.rows[0].accuracy.footing->pixels = 100;
    EXPECT_FALSE(is_unanswered(report));
    EXPECT_EQ(nlohmann::json::parse(as_json(report))["answer"]["recommended"]["technique"], "transparency/weighted");
}

}  // namespace
}  // namespace strata
