// A comparison of reports for every format: sentences, a row for each row of both, and what only one of them has.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "replay/compare/report_comparison.h"
#include "replay/json_text.h"
#include "replay/plural.h"
#include "replay/report/report_columns.h"
#include "replay/report/variants.h"
#include "replay/tables/document.h"
#include "replay/tables/table.h"

namespace strata {
namespace {

using nlohmann::ordered_json;
using Columns = std::vector<Column<RowComparison>>;

/// A cost in words.
struct CostWords {
    std::string_view title, is, thing, unit;
};
CostWords words_of(CostKind cost) {
    static constexpr std::array all{
        CostWords{"ms", "milliseconds of the stage (median)", "time", "ms"},
        CostWords{"time", "time of the stage as a multiple of its baseline's", "time", "times the baseline's"},
        CostWords{"bytes per pixel", "memory that the technique allocates", "memory", "bytes per pixel"}};
    return all[static_cast<std::size_t>(cost)];
}

Column<RowComparison> name_column(const char* key, const char* help, std::string RowComparison::*text) {
    return {{.key = key, .title = key, .help = help, .kind = CellKind::text, .shown = in_files},
            [text](const RowComparison& row) { return row.*text; }};
}

void add_errors(Columns& columns, const RankingError& error) {
    const std::string unit = error.is_of_white ? ", %" : "";
    for (const auto& [side, value] : {std::pair("A", &RowComparison::error_a), std::pair("B", &RowComparison::error_b)})
        columns.push_back({{.key = fmt::format("error_{}", side[0] == 'A' ? "a" : "b"),
                            .title = fmt::format("error {}{}", side, unit),
                            .help = fmt::format("error in {} by which rows are ranked", side),
                            .kind = kind_of(error),
                            .better = Better::less},
                           [value = value](const RowComparison& row) { return row.*value; }});
    columns.push_back(
        {{.key = "error_ratio",
          .title = "error B / A",
          .help = "the error in B as a multiple of that in A",
          .better = Better::less,
          .digits = ".2f"},
         [](const RowComparison& row) { return row.error_a > 0 ? CellValue(row.error_b / row.error_a) : CellValue(); }});
}

void add_costs(Columns& columns, CostKind cost) {
    const CostWords words = words_of(cost);
    for (const auto& [side, value] : {std::pair("A", &RowComparison::cost_a), std::pair("B", &RowComparison::cost_b)})
        columns.push_back({{.key = fmt::format("{}_{}", name(cost), side[0] == 'A' ? "a" : "b"),
                            .title = fmt::format("{} {}", words.title, side),
                            .help = fmt::format("{} in {}", words.is, side),
                            .better = Better::less},
                           [value = value](const RowComparison& row) { return row.*value; }});
    columns.push_back({{.key = "ratio",
                        .title = fmt::format("{} B / A", words.thing),
                        .help = "the cost in B as a multiple of that in A",
                        .better = Better::less,
                        .digits = ".2f"},
                       [](const RowComparison& row) { return cell_or_nothing(row.ratio); }});
    columns.push_back({{.key = "interval",
                        .title = "95 % interval",
                        .help = "of that ratio, from the spread of the repeats",
                        .kind = CellKind::text,
                        .shown = in_text,
                        .if_any = true},
                       [](const RowComparison& row) {
                           if (!row.interval) return CellValue();
                           return CellValue(fmt::format("{:.2f} to {:.2f}", row.interval->low, row.interval->high));
                       }});
    for (const auto& [key, end] : {std::pair("ratio_low", &Interval::low), std::pair("ratio_high", &Interval::high)})
        columns.push_back(
            {{.key = key,
              .title = key,
              .help = fmt::format("{} end of the 95 % interval of the ratio, from the spread of the repeats",
                                  end == &Interval::low ? "lower" : "upper"),
              .shown = in_files},
             [end = end](const RowComparison& row) { return row.interval ? CellValue((*row.interval).*end) : CellValue(); }});
    columns.push_back({{.key = "is_told_apart",
                        .title = "",
                        .help = "the 95 % interval of the ratio does not contain 1",
                        .kind = CellKind::flag,
                        .shown = in_files},
                       [](const RowComparison& row) { return row.interval ? CellValue(row.is_told_apart()) : CellValue(); }});
}

void add_memory(Columns& columns) {
    for (const auto& [side, value] :
         {std::pair("A", &RowComparison::bytes_per_pixel_a), std::pair("B", &RowComparison::bytes_per_pixel_b)})
        columns.push_back({{.key = fmt::format("bytes_per_pixel_{}", side[0] == 'A' ? "a" : "b"),
                            .title = fmt::format("bytes per pixel {}", side),
                            .help = fmt::format("memory that the technique allocates in {}", side),
                            .better = Better::less,
                            .digits = ".0f"},
                           [value = value](const RowComparison& row) { return row.*value; }});
}

RowName name_of_row(const RowComparison& row) {
    return {!row.is_told_apart() ? " " : row.interval->high < 1 ? "<" : ">", short_label(row)};
}

std::string differences_text(const ReportComparison& made) {
    std::string text;
    for (const ReportDifference& difference : made.differences)
        text += fmt::format("{} of A: {}, of B: {}\n", difference.what, difference.a, difference.b);
    if (made.a.capture_id != made.b.capture_id || made.a.frame != made.b.frame)
        text += "! the reports are of different frames: they differ by what is drawn, too\n";
    return text;
}

std::string not_ranked_text(const char* side, const StoredReport& report) {
    std::vector<std::string> parts;
    const auto add = [&](std::size_t count, const char* why) {
        if (count > 0) parts.push_back(fmt::format("{} {}", plural(count, "row"), why));
    };
    add(report.not_supported, "not supported");
    add(report.with_other_truth, "against another truth");
    add(report.without_finite_error, "without a finite error");
    return parts.empty() ? "" : fmt::format("not compared of {}: {}\n", side, fmt::join(parts, ", "));
}

/// A line where more than 5 % of the draws say nothing.
std::string draws_note(std::string_view equal, const std::optional<Change>& change, std::uint32_t draws) {
    if (!change || 20 * change->draws_without_it <= draws) return "";
    return fmt::format("at equal {}: {} of the {} draws of the interval have no range in common and are left out\n", equal,
                       change->draws_without_it, draws);
}

std::string curves_text(const ReportComparison& made) {
    const std::string_view thing = words_of(made.cost).thing;
    std::string text;
    if (const auto overlap = check_overlap(made); !overlap) text += wrapped("", overlap.error().sentence);
    if (const auto& change = made.curves.cost)
        text += fmt::format("at equal error B takes {} {}{}, over errors of {} to {}\n", change_text(change->ratio), thing,
                            interval_note(*change), made.a.ranked_by.text(change->over.low),
                            made.a.ranked_by.text(change->over.high));
    if (const auto& change = made.curves.error)
        text += fmt::format("at equal {} B's error is {}{}, over {} to {} {}\n", thing, change_text(change->ratio),
                            interval_note(*change), short_number(change->over.low), short_number(change->over.high),
                            words_of(made.cost).unit);
    else if (made.curves.cost) text += fmt::format("at equal {0}: no {0} is reached by both curves\n", thing);
    if (has_row_of_few_repeats(made))
        text += "rows timed once have no spread, and those timed twice too little: intervals are too narrow\n";
    if (made.cost == CostKind::ms && made.curves.draws > 0)
        text += "intervals hold the spread within each report, not a machine that was slower during one: see --cost time\n";
    return text + draws_note("error", made.curves.cost, made.curves.draws) +
           draws_note(thing, made.curves.error, made.curves.draws);
}

std::string heading(const ReportComparison& made) {
    std::string text = fmt::format("{} of {} (A) and {} (B): error is {}, cost is {}\n", made.a.stage, made.a.file, made.b.file,
                                   made.a.ranked_by.name, words_of(made.cost).is);
    text += differences_text(made) + not_ranked_text("A", made.a) + not_ranked_text("B", made.b);
    return text + "\n" + curves_text(made) + "\n";
}

std::string only_text(const char* side, const std::vector<std::string>& rows) {
    return rows.empty() ? "" : wrapped("", fmt::format("only in {}: {}", side, fmt::join(rows, ", ")));
}

std::string counters_text(const ReportComparison& made) {
    constexpr std::size_t most = 8;
    std::vector<std::string> lines;
    for (const RowComparison& row : made.rows)
        for (const CounterDifference& counter : row.counters)
            lines.push_back(fmt::format("   {}: {} {} -> {}\n", short_label(row), counter.name, counter.a, counter.b));
    if (lines.empty()) return "";
    const std::size_t shown = std::min(lines.size(), most);
    std::string text =
        fmt::format("\ncounted in A -> B\n{}", fmt::join(lines.begin(), lines.begin() + std::ptrdiff_t(shown), ""));
    if (lines.size() > shown) text += fmt::format("   {} more; --json has all\n", lines.size() - shown);
    return text;
}

std::string below_table(const ReportComparison& made) {
    std::string text = "\n";
    if (std::ranges::any_of(made.rows, &RowComparison::is_told_apart))
        text += "< B costs less, > B costs more: the interval does not contain 1; of 100 equal rows about 5 have a mark\n";
    text += only_text("A", made.only_a) + only_text("B", made.only_b) + counters_text(made);
    return text == "\n" ? "" : text;
}

ordered_json json_of(const StoredReport& report, const std::vector<std::string>& only) {
    return {{"file", report.file},
            {"program", report.program},
            {"device", report.device},
            {"driver", report.driver},
            {"capture_id", report.capture_id},
            {"capture_name", report.capture_name},
            {"frame", report.frame},
            {"extent", {report.width, report.height}},
            {"samples", report.samples},
            {"ranked_rows", report.rows.size()},
            {"not_supported", report.not_supported},
            {"with_other_truth", report.with_other_truth},
            {"without_finite_error", report.without_finite_error},
            {"only_here", only}};
}

ordered_json json_of(const std::optional<Change>& change) {
    if (!change) return {};
    ordered_json json{{"ratio", cell_json(change->ratio)}};
    if (change->interval) json["interval"] = {cell_json(change->interval->low), cell_json(change->interval->high)};
    json["over"] = {cell_json(change->over.low), cell_json(change->over.high)};
    json["draws_without_it"] = change->draws_without_it;
    return json;
}

/// The rows that are corners of a curve.
ordered_json json_of(const std::vector<HullPoint>& hull, const StoredReport& report) {
    ordered_json json = ordered_json::array();
    for (const HullPoint& corner : hull) {
        const StoredRow& row = report.rows[corner.point];
        json.push_back({{"technique", row.technique},
                        {"settings", row.settings},
                        {"error", cell_json(std::exp(corner.log_error))},
                        {"cost", cell_json(std::exp(corner.log_cost))}});
    }
    return json;
}

}  // namespace

Sheet sheet_of(const ReportComparison& made) {
    Columns columns{name_column("technique", "stage and technique", &RowComparison::technique),
                    name_column("settings", "what differs from the technique's defaults", &RowComparison::settings)};
    add_errors(columns, made.a.ranked_by);
    add_costs(columns, made.cost);
    if (made.cost != CostKind::bytes_per_pixel) add_memory(columns);
    Sheet sheet = sheet_of<RowComparison>(columns, made.rows, name_of_row);
    sheet.heads_labels = fmt::format("{} and settings", made.a.stage);
    return sheet;
}

Page page_of(const ReportComparison& made) {
    if (made.rows.empty()) return {heading(made) + "no row is in both reports\n" + below_table(made)};
    return {heading(made), sheet_of(made), below_table(made)};
}

std::string as_text(const ReportComparison& made) { return as_text(page_of(made)); }

std::string as_csv(const ReportComparison& made) { return as_csv(std::array{sheet_of(made)}); }

std::string as_json(const ReportComparison& made) {
    ordered_json json = document({.schema = "strata.report_comparison", .date = made.date});
    json.update({{"stage", made.a.stage},
                 {"error_at", made.a.error_at},
                 {"ranked_by", made.a.ranked_by.name},
                 {"cost", name(made.cost)},
                 {"a", json_of(made.a, made.only_a)},
                 {"b", json_of(made.b, made.only_b)}});
    json["differences"] = ordered_json::array();
    for (const ReportDifference& difference : made.differences)
        json["differences"].push_back({{"what", difference.what}, {"a", difference.a}, {"b", difference.b}});
    json["draws"] = made.curves.draws;
    json["at_equal_error"] = json_of(made.curves.cost);
    json["at_equal_cost"] = json_of(made.curves.error);
    json["curve_a"] = json_of(made.curves.a, made.a);
    json["curve_b"] = json_of(made.curves.b, made.b);
    json["rows"] = rows_json(sheet_of(made));
    for (std::size_t i = 0; i < made.rows.size(); ++i) {
        json["rows"][i]["counters"] = ordered_json::object();
        for (const CounterDifference& counter : made.rows[i].counters)
            json["rows"][i]["counters"][counter.name] = {{"a", counter.a}, {"b", counter.b}};
    }
    return json_text(json);
}

}  // namespace strata
