// What a cell of a published table says of itself, for every format; below each table text has why cells have no number, and what
// every variant held and counted.
#include <algorithm>
#include <iterator>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "passes/claims.h"
#include "passes/technique.h"
#include "replay/bench/published_tables.h"
#include "replay/json_text.h"
#include "replay/plural.h"
#include "replay/tables/document.h"
#include "replay/tables/table.h"

namespace strata {
namespace {

using Cells = std::vector<Column<MeasuredTableCell>>;

Described in_files_alone(std::string key, std::string help, CellKind kind) {
    return {.key = key, .title = key, .help = std::move(help), .kind = kind, .shown = in_files};
}

/// Whole numbers whole, and the others as a source prints them.
std::string measured_text(const CellValue& value) {
    const Described is{.key = "", .title = "", .help = "", .kind = CellKind::spread};
    if (const auto* count = std::get_if<std::uint64_t>(&value)) return fmt::format("{}", *count);
    if (const auto* number = std::get_if<double>(&value)) return fmt::format("{:.6g}", *number);
    return cell_text(is, value);
}

std::string published_text(const TableCell& stated) {
    if (!stated.printed.empty()) return std::string(stated.printed);
    return stated.published ? fmt::format("{:.9g}", *stated.published) : "";
}

Cells names_of_cell() {
    return {{in_files_alone("row", "row of the table: a variant", CellKind::text),
             [](const MeasuredTableCell& cell) { return cell.row; }},
            {in_files_alone("column", "column of the table", CellKind::text),
             [](const MeasuredTableCell& cell) { return cell.column; }},
            {in_files_alone("unit", "unit of the column", CellKind::text),
             [](const MeasuredTableCell& cell) { return cell_if_any(cell.unit); }}};
}

Cells numbers_of_cell() {
    return {
        {in_files_alone("measured", "number of this device; a time is the median of its repeats", CellKind::spread),
         [](const MeasuredTableCell& cell) { return cell.measured; }},
        {{.key = "measured_text", .title = "measured", .help = "", .kind = CellKind::text, .shown = in_text},
         [](const MeasuredTableCell& cell) { return measured_text(cell.measured); }},
        {in_files_alone("published", "number that the source prints; absent if it prints none", CellKind::number),
         [](const MeasuredTableCell& cell) { return cell_or_nothing(cell.stated->published); }},
        {in_files_alone("published_text", "what the source prints instead of a plain number: a bound or a range", CellKind::text),
         [](const MeasuredTableCell& cell) { return cell_if_any(std::string(cell.stated->printed)); }},
        {{.key = "printed", .title = "published", .help = "", .kind = CellKind::text, .shown = in_text},
         [](const MeasuredTableCell& cell) { return published_text(*cell.stated); }},
        {{.key = "derived",
          .title = "derived",
          .help = "Strata's own arithmetic from numbers of the source; never a published number",
          .shown = in_text | in_files,
          .digits = ".6g",
          .if_any = true},
         [](const MeasuredTableCell& cell) { return cell_or_nothing(cell.stated->derived); }}};
}

Cells multiples_of_cell() {
    return {{{.key = "multiple",
              .title = "x first row",
              .help = "multiple of the measured number of the table's first row in the same column, of times within each repeat",
              .kind = CellKind::median,
              .shown = in_text | in_files,
              .digits = ".2f"},
             [](const MeasuredTableCell& cell) { return cell.multiple; }},
            {{.key = "published_multiple",
              .title = "published x first row",
              .help = "the same of the published numbers",
              .kind = CellKind::number,
              .shown = in_text | in_files,
              .digits = ".2f"},
             [](const MeasuredTableCell& cell) { return cell_or_nothing(cell.published_multiple); }},
            {in_files_alone("not_measured", "why there is no measured number: no such variant, step or counter", CellKind::text),
             [](const MeasuredTableCell& cell) { return cell_if_any(cell.not_measured); }}};
}

/// "draws, ms: MBOIT"; of a table with one column the row alone.
std::string label_of(const MeasuredTable& table, const MeasuredTableCell& cell) {
    if (table.claim.table->columns.size() == 1) return cell.row;
    return fmt::format("{}{}{}: {}", cell.column, cell.unit.empty() ? "" : ", ", cell.unit, cell.row);
}

std::string head_of(const MeasuredTable& table) {
    const PublishedTable& stated = *table.claim.table;
    const TableValueColumn& only = stated.columns.front();
    const std::string what = stated.columns.size() > 1 ? "" : fmt::format(", {} in {}", only.title, only.unit);
    const std::string where = table.width == 0 ? "nothing is run"
                                               : fmt::format("measured on {}, {} x {}, {} per pixel", table.claim.scene,
                                                             table.width, table.height, plural(table.samples, "sample"));
    return wrapped("", fmt::format("{}: {}{}; {}", table.claim.technique->name, stated.title, what, where)) +
           wrapped("    ", fmt::format("published: {}", stated.source)) + "\n";
}

/// Labels of cells by the reason for which they have no number.
std::string reasons_of(const MeasuredTable& table) {
    std::map<std::string, std::vector<std::string>> cells;
    for (const MeasuredTableCell& cell : table.cells)
        if (!cell.not_measured.empty()) cells[cell.not_measured].push_back(label_of(table, cell));
    std::string text;
    for (const auto& [reason, labels] : cells)
        text += wrapped("    ", fmt::format("not measured ({}): {}", reason, fmt::join(labels, "; ")));
    return text;
}

std::string row_text(const MeasuredTableRow& row) {
    std::vector<std::string> parts{fmt::format("{:.2f} MiB", double(row.stage_bytes) / 0x1p20)};
    for (const CounterRecord& counter : row.counters) parts.push_back(fmt::format("{} {}", counter.name, counter.value));
    const std::string against = row.against.empty() ? "" : " against " + row.against;
    return fmt::format("{}: {}{}: {}", row.row, row.variant, against, fmt::join(parts, ", "));
}

std::string details_of(const MeasuredTable& table) {
    const PublishedTable& stated = *table.claim.table;
    std::string text = reasons_of(table);
    if (!stated.derivation.empty()) text += wrapped("    ", fmt::format("derived, not published: {}", stated.derivation));
    if (!stated.note.empty()) text += wrapped("    ", fmt::format("note: {}", stated.note));
    const RatioWitness& witness = stated.witness;
    if (!witness.counter.empty())
        text += wrapped("    ", fmt::format("witness: {} > {:g}: {}", witness.counter, witness.more_than,
                                            table.is_witnessed ? "yes" : fmt::format("no; {}", witness.otherwise)));
    for (const MeasuredTableRow& row : table.rows) text += wrapped("    ", row_text(row));
    return text;
}

/// What of a table is no cell.
nlohmann::ordered_json parts_of(const MeasuredTable& table) {
    const PublishedTable& stated = *table.claim.table;
    nlohmann::ordered_json json{{"technique", table.claim.technique->name}, {"title", stated.title}, {"source", stated.source}};
    if (!stated.derivation.empty()) json["derivation"] = stated.derivation;
    if (!stated.note.empty()) json["note"] = stated.note;
    if (table.width > 0) {
        json["scene"] = table.claim.scene;
        json["frame"] = table.claim.base.variant.frame;
        json["extent"] = {table.width, table.height};
        json["samples"] = table.samples;
    }
    if (const RatioWitness& witness = stated.witness; !witness.counter.empty())
        json["witness"] = {{"counter", witness.counter}, {"more_than", witness.more_than}, {"happened", table.is_witnessed}};
    json["variants"] = nlohmann::ordered_json::array();
    for (const MeasuredTableRow& row : table.rows) {
        nlohmann::ordered_json variant{{"row", row.row}, {"variant", row.variant}, {"stage_bytes", row.stage_bytes}};
        if (!row.against.empty()) variant["against"] = row.against;
        variant["counters"] = nlohmann::ordered_json::object();
        for (const CounterRecord& counter : row.counters) variant["counters"][counter.name] = counter.value;
        json["variants"].push_back(std::move(variant));
    }
    json["rows"] = rows_json(sheet_of(table));
    return json;
}

}  // namespace

Sheet sheet_of(const MeasuredTable& table) {
    Cells columns = names_of_cell();
    for (Cells more : {numbers_of_cell(), multiples_of_cell()}) std::ranges::move(more, std::back_inserter(columns));
    Sheet sheet = sheet_of<MeasuredTableCell>(columns, table.cells, [&](const MeasuredTableCell& cell) {
        return RowName{"", label_of(table, cell)};
    });
    sheet.heads_labels = "row";
    if (table.claim.table)
        sheet.of_every_row = {{"technique", std::string(table.claim.technique->name)},
                              {"table", std::string(table.claim.table->title)},
                              {"scene", table.width == 0 ? "" : table.claim.scene}};
    return sheet;
}

Page page_of(const PublishedTables& tables) {
    std::string text = fmt::format("device {} ({}), {} of each variant, in turn within one run\n", tables.device.name,
                                   tables.device.driver, plural(tables.repeats, "timed run"));
    if (tables.device.software) text += "a CPU renders here: times rank variants on this driver only, they model no GPU\n";
    Page page;
    for (const MeasuredTable& table : tables.tables) {
        page.emplace_back(text + "\n" + head_of(table));
        page.emplace_back(sheet_of(table));
        text = "\n" + details_of(table);
    }
    if (!tables.stopped.empty()) text += fmt::format("\n{}\n", tables.stopped);
    page.emplace_back(text);
    return page;
}

std::string as_text(const PublishedTables& tables) { return as_text(page_of(tables)); }

std::string as_csv(const PublishedTables& tables) {
    std::vector<Sheet> sheets;
    sheets.reserve(tables.tables.size());
    for (const MeasuredTable& table : tables.tables) sheets.push_back(sheet_of(table));
    return as_csv(sheets);
}

std::string as_json(const PublishedTables& tables) {
    nlohmann::ordered_json json = document({.schema = "strata.bench_tables", .date = tables.date, .device = &tables.device});
    json["repeats"] = tables.repeats;
    json["tables"] = nlohmann::ordered_json::array();
    for (const MeasuredTable& table : tables.tables) json["tables"].push_back(parts_of(table));
    if (!tables.stopped.empty()) json["stopped"] = tables.stopped;
    return json_text(json);
}

}  // namespace strata
