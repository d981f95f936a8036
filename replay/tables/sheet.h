// Rows as data: a list of columns, each with its one description, and what every format makes of it. A new column is one entry of
// such a list.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "replay/tables/cell.h"

namespace strata {

template <typename Row>
struct Column {
    Described is;
    std::function<CellValue(const Row&)> value;
    /// Also of rows that have no numbers: what names the row, and why it has none.
    enum class Of { measured_rows, every_row } of = Of::measured_rows;
};

/// What a row is called, beside its values.
struct RowName {
    std::string marks, label;
    std::string instead = {};  ///< why it has no numbers: "not supported: ..."; stands for all cells
};

/// Columns and rows without their types.
struct Sheet {
    struct Row {
        RowName name;
        std::vector<CellValue> values;
    };
    std::string heads_labels = {};  ///< above the labels, where a format has a head for them
    std::vector<Described> columns;
    std::vector<Row> rows;
    std::vector<std::pair<std::string, std::string>> of_every_row = {};  ///< CSV's first columns: {"capture", "a.strata"}
};

template <typename Row, typename Name>
Sheet sheet_of(const std::vector<Column<Row>>& columns, std::span<const Row> rows, const Name& name_of) {
    Sheet sheet;
    for (const Column<Row>& column : columns) sheet.columns.push_back(column.is);
    for (const Row& row : rows) {
        Sheet::Row& made = sheet.rows.emplace_back(Sheet::Row{name_of(row), {}});
        for (const Column<Row>& column : columns) {
            const bool has_it = made.name.instead.empty() || column.of == Column<Row>::Of::every_row;
            made.values.push_back(has_it ? column.value(row) : CellValue());
        }
    }
    return sheet;
}

/// A table of 120 columns (table.h).
std::string as_text(const Sheet&);
/// The same without labels and marks: words to the left, numbers to the right of their columns; heads do not break.
std::string as_lines(const Sheet&);
/// A table of GitHub's Markdown.
std::string as_markdown(const Sheet&);
/// One table with a head. Sheets may have different columns: those of one key are one column. A spread is two, KEY and KEY_mad.
std::string as_csv(std::span<const Sheet>);
/// The values of a row by their keys, added to what is there.
void add_values(nlohmann::ordered_json&, const Sheet&, std::size_t row);
/// Every row as an object.
nlohmann::ordered_json rows_json(const Sheet&);

/// What a cell is in a window.
struct WindowCell {
    std::string text;            ///< a dash where there is nothing
    std::optional<double> sort;  ///< none: after all that have one
};
WindowCell window_cell(const Described&, const CellValue&);
/// Over a column of the window, and what its tooltip says.
std::string window_title(const Described&);
std::string window_tooltip(const Described&);

/// Text and tables in the order in which they are printed.
struct Lines {
    Sheet sheet;  ///< as_lines()
};
using Page = std::vector<std::variant<std::string, Sheet, Lines>>;
std::string as_text(const Page&);
/// Text as it is, in fences.
std::string as_markdown(const Page&);

/// The columns of a sheet as a table of Markdown, for documents: titles of those in text, or keys of those in files.
enum class DocumentedBy { title, key };
std::string columns_markdown(const Sheet&, DocumentedBy);

}  // namespace strata
