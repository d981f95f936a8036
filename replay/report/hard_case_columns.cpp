// The matrix of hard cases: what it says of each case, for every format.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "replay/json_text.h"
#include "replay/report/hard_cases.h"
#include "replay/tables/document.h"
#include "replay/tables/sheet.h"

namespace strata {
namespace {

// Of a table of 120 columns, beside labels of 29.
constexpr std::size_t cases_side_by_side = 11;

/// A case of a row.
struct HardCell {
    const HardCaseRow& row;
    const HardCase& hard_case;
    const HardOutcome& outcome;
};
using ColumnsOfCells = std::vector<Column<HardCell>>;

bool is_applicable(const HardCell& cell) { return cell.outcome.verdict != HardOutcome::Verdict::not_applicable; }

ColumnsOfCells names_of_cell() {
    return {{{.key = "technique", .title = "technique", .help = "stage and technique", .kind = CellKind::text, .shown = in_csv},
             [](const HardCell& cell) { return cell.row.technique; }},
            {{.key = "settings",
              .title = "settings",
              .help = "what differs from the technique's defaults",
              .kind = CellKind::text,
              .shown = in_csv},
             [](const HardCell& cell) { return cell.row.settings; }},
            {{.key = "case", .title = "case", .help = "name", .kind = CellKind::text, .shown = in_files},
             [](const HardCell& cell) { return std::string(id(cell.hard_case)); }},
            {{.key = "question", .title = "question", .help = "what the case tests", .kind = CellKind::text, .shown = in_files},
             [](const HardCell& cell) { return std::string(cell.hard_case.question); }}};
}

ColumnsOfCells judgments() {
    return {
        {{.key = "tolerance",
          .title = "holds at",
          .help = "largest error that passes",
          .better = Better::less,
          .shown = in_files},
         [](const HardCell& cell) { return cell.hard_case.tolerance; }},
        {{.key = "verdict",
          .title = "verdict",
          .help = "`holds`, `not applicable`; at the defaults `documented failure`, `undocumented failure`, `better than "
                  "documented`; at a point `fails`",
          .kind = CellKind::text,
          .shown = in_files},
         [](const HardCell& cell) { return std::string(name(cell.outcome.verdict)); }},
        {{.key = "error",
          .title = "error",
          .help =
              "error of the worst pixel, as the case measures it, relative to max(1, truth); \"inf\": a pixel is NaN or infinite",
          .better = Better::less,
          .shown = in_files},
         [](const HardCell& cell) { return is_applicable(cell) ? CellValue(cell.outcome.error) : CellValue(); }},
        {{.key = "smallest_share",
          .title = "smallest share",
          .help = "H3: smallest share of the front card over the positions of the eye; exact: 1",
          .shown = in_files},
         [](const HardCell& cell) { return cell.outcome.shares ? CellValue(cell.outcome.shares->smallest) : CellValue(); }},
        {{.key = "largest_share",
          .title = "largest share",
          .help = "H3: largest share of the front card over the positions of the eye; exact: 1",
          .shown = in_files},
         [](const HardCell& cell) { return cell.outcome.shares ? CellValue(cell.outcome.shares->largest) : CellValue(); }},
        {{.key = "model_worst",
          .title = "model worst",
          .help = "largest difference between device and model",
          .better = Better::less,
          .shown = in_files},
         [](const HardCell& cell) { return is_applicable(cell) ? CellValue(cell.outcome.model_worst) : CellValue(); }},
        {{.key = "documented", .title = "documented", .help = "error that the technique documents", .shown = in_files},
         [](const HardCell& cell) { return cell.outcome.documented > 0 ? CellValue(cell.outcome.documented) : CellValue(); }},
        {{.key = "because",
          .title = "because",
          .help = "the technique's reason for its error; or why the case does not apply",
          .kind = CellKind::text,
          .shown = in_files},
         [](const HardCell& cell) { return cell_if_any(cell.outcome.reason); }}};
}

/// The cases of a row.
std::vector<HardCell> cells_of(const HardCaseRow& row) {
    std::vector<HardCell> cells;
    for (std::size_t c = 0; c < row.outcomes.size(); ++c) cells.push_back({row, hard_cases()[c], row.outcomes[c]});
    return cells;
}

Sheet sheet_of_cells(std::span<const HardCell> cells) {
    ColumnsOfCells columns = names_of_cell();
    std::ranges::move(judgments(), std::back_inserter(columns));
    return sheet_of<HardCell>(columns, cells, [](const HardCell&) { return RowName(); });
}

/// Cases beside each other.
Sheet matrix_of(const HardCaseReport& report, std::size_t first_case, std::size_t count) {
    std::vector<Column<HardCaseRow>> columns;
    for (std::size_t c = first_case; c < first_case + count; ++c) {
        const std::string key(id(hard_cases()[c]));
        columns.push_back({{.key = key, .title = key, .help = std::string(hard_cases()[c].question), .shown = in_text},
                           [c](const HardCaseRow& row) { return matrix_cell(row.outcomes[c]); }});
    }
    return sheet_of<HardCaseRow>(columns, report.rows, [](const HardCaseRow& row) { return RowName{"", short_label(row)}; });
}

/// Smallest and largest share of the front card, of every row.
std::string share_lines(const HardCaseReport& report) {
    std::string text;
    for (const HardCaseRow& row : report.rows)
        for (const HardCell& cell : cells_of(row))
            if (cell.outcome.shares)
                text += fmt::format("   {:<28} {:.3f} to {:.3f}\n", short_label(row), cell.outcome.shares->smallest,
                                    cell.outcome.shares->largest);
    return text.empty() ? text
                        : "\nH3: smallest and largest share of the front card over 33 positions of the eye (exact: 1)\n" + text;
}

}  // namespace

std::string matrix_cell(const HardOutcome& outcome) {
    using Verdict = HardOutcome::Verdict;
    switch (outcome.verdict) {
        case Verdict::holds:
            return "ok";
        case Verdict::not_applicable:
            return "-";
        case Verdict::documented:
        case Verdict::fails:
            return fmt::format("{:.2g}", outcome.error);
        case Verdict::undocumented:
            return fmt::format("{:.2g}!", outcome.error);
        case Verdict::undeserved:
            return "ok?";
    }
    return "";
}

Sheet sheet_of(const HardCaseReport& report) {
    std::vector<HardCell> all;
    for (const HardCaseRow& row : report.rows)
        for (const HardCell& cell : cells_of(row)) all.push_back(cell);
    return sheet_of_cells(all);
}

Page page_of(const HardCaseReport& report) {
    std::string text = fmt::format("hard cases of transparency on {} ({})\n\n", report.device.name, report.device.driver);
    const std::size_t cases = report.rows.empty() ? 0 : report.rows.front().outcomes.size();
    for (const HardCase& hard_case : hard_cases().first(cases))
        text += fmt::format("   {:<28} holds at {:.2g}\n", hard_case.name, hard_case.tolerance);
    Page page{text};
    for (std::size_t first = 0; first < cases; first += cases_side_by_side)
        page.insert(page.end(), {"\n", matrix_of(report, first, std::min(cases_side_by_side, cases - first))});
    page.emplace_back(share_lines(report));
    page.emplace_back(
        "\nok: holds. A number: fails by so much, at its defaults as the technique documents. -: not applicable.\n"
        "!: a failure that is not documented, or of another size. ok?: holds what is documented as a failure.\n" +
        (report.stopped.empty() ? "" : '\n' + report.stopped + '\n'));
    return page;
}

std::string as_text(const HardCaseReport& report) { return as_text(page_of(report)); }
std::string as_csv(const HardCaseReport& report) { return as_csv(std::vector{sheet_of(report)}); }

std::string as_json(const HardCaseReport& report) {
    using nlohmann::ordered_json;
    ordered_json json = document({.schema = "strata.hard_cases", .date = report.date, .device = &report.device});
    json["device"] = report.device.name;
    json["driver"] = report.device.driver;
    json["rows"] = ordered_json::array();
    if (!report.stopped.empty()) json["stopped"] = report.stopped;
    for (const HardCaseRow& row : report.rows) {
        json["rows"].push_back({{"technique", row.technique}, {"settings", row.settings}});
        json["rows"].back()["cases"] = rows_json(sheet_of_cells(cells_of(row)));
    }
    return json_text(json);
}

}  // namespace strata
