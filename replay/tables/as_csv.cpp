// Sheets as comma-separated values, for spreadsheets and plots (RFC 4180).
#include <algorithm>

#include <fmt/format.h>

#include "replay/tables/sheet.h"

namespace strata {
namespace {

struct CsvColumn {
    std::string key;
    bool has_spread = false;
};

/// Those of all sheets, in the order in which they come first.
std::vector<CsvColumn> columns_of(std::span<const Sheet> sheets) {
    std::vector<CsvColumn> columns;
    for (const Sheet& sheet : sheets)
        for (const Described& is : sheet.columns) {
            if ((is.shown & in_csv) == 0) continue;
            const auto known = std::ranges::find(columns, is.key, &CsvColumn::key);
            if (known == columns.end()) columns.push_back({is.key, has_spread(is)});
            else known->has_spread = known->has_spread || has_spread(is);
        }
    return columns;
}

std::string head_csv(const std::string& key) { return key.find_first_of(",\"\n") == key.npos ? key : cell_csv(key); }

/// A sheet's column of that key, or null.
const CellValue* value_in(const Sheet& sheet, const Sheet::Row& row, const std::string& key) {
    for (std::size_t i = 0; i < sheet.columns.size(); ++i)
        if ((sheet.columns[i].shown & in_csv) != 0 && sheet.columns[i].key == key) return &row.values[i];
    return nullptr;
}

std::string fields_of(const CsvColumn& column, const CellValue* value) {
    const std::string field = value ? cell_csv(*value) : std::string();
    if (!column.has_spread) return field;
    const Spread* spread = value ? std::get_if<Spread>(value) : nullptr;
    return field + "," + (spread ? cell_csv(spread->mad) : std::string());
}

std::string line_of(std::span<const std::string> fields) { return fmt::format("{}\n", fmt::join(fields, ",")); }

}  // namespace

std::string as_csv(std::span<const Sheet> sheets) {
    const std::vector<CsvColumn> columns = columns_of(sheets);
    std::vector<std::string> fields;
    if (!sheets.empty())
        for (const auto& [key, text] : sheets.front().of_every_row) fields.push_back(head_csv(key));
    for (const CsvColumn& column : columns) {
        fields.push_back(head_csv(column.key));
        if (column.has_spread) fields.push_back(head_csv(column.key + "_mad"));
    }
    std::string csv = line_of(fields);
    for (const Sheet& sheet : sheets)
        for (const Sheet::Row& row : sheet.rows) {
            fields.clear();
            for (const auto& [key, text] : sheet.of_every_row) fields.push_back(cell_csv(text));
            for (const CsvColumn& column : columns) fields.push_back(fields_of(column, value_in(sheet, row, column.key)));
            csv += line_of(fields);
        }
    return csv;
}

}  // namespace strata
