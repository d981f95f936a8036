// Sheets for a terminal and for a window.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "replay/tables/sheet.h"
#include "replay/tables/shown_columns.h"
#include "replay/tables/table.h"

namespace strata {

std::string as_text(const Sheet& sheet) {
    const std::vector<std::size_t> shown = shown_columns(sheet, in_text);
    Table table;
    for (const std::size_t column : shown) table.heads.push_back(sheet.columns[column].title);
    for (const Sheet::Row& row : sheet.rows) {
        Table::Row line{row.name.marks, row.name.label, {}};
        if (!row.name.instead.empty()) line.cells = {row.name.instead};
        else
            for (const std::size_t column : shown) line.cells.push_back(cell_text(sheet.columns[column], row.values[column]));
        table.rows.push_back(std::move(line));
    }
    return as_text(table);
}

std::string as_lines(const Sheet& sheet) {
    const std::vector<std::size_t> shown = shown_columns(sheet, in_text);
    std::vector<std::size_t> widths;
    for (const std::size_t column : shown) {
        const Described& is = sheet.columns[column];
        widths.push_back(std::max(is.width, is.title.size()));
        for (const Sheet::Row& row : sheet.rows)
            widths.back() = std::max(widths.back(), cell_text(is, row.values[column]).size());
    }
    std::string text, line;
    const auto add = [&](std::size_t i, const std::string& cell) {
        const bool is_text = sheet.columns[shown[i]].kind == CellKind::text;
        line += is_text ? fmt::format("  {:<{}}", cell, widths[i]) : fmt::format("  {:>{}}", cell, widths[i]);
    };
    const auto end_line = [&] {
        line.erase(line.find_last_not_of(' ') + 1);
        text += std::exchange(line, "") + "\n";
    };
    for (std::size_t i = 0; i < shown.size(); ++i) add(i, sheet.columns[shown[i]].title);
    end_line();
    for (const Sheet::Row& row : sheet.rows) {
        for (std::size_t i = 0; i < shown.size(); ++i) {
            const CellValue& value = row.values[shown[i]];
            if (row.name.instead.empty() || !is_nothing(value)) add(i, cell_text(sheet.columns[shown[i]], value));
        }
        if (!row.name.instead.empty()) line += "  " + row.name.instead;
        end_line();
    }
    return text;
}

std::string as_text(const Page& page) {
    std::string text;
    for (const auto& part : page) {
        if (const auto* words = std::get_if<std::string>(&part)) text += *words;
        else if (const auto* lines = std::get_if<Lines>(&part)) text += as_lines(lines->sheet);
        else text += as_text(std::get<Sheet>(part));
    }
    return text;
}

WindowCell window_cell(const Described& is, const CellValue& value) {
    const std::optional<double> number = cell_number(value);
    if (is_nothing(value) || std::holds_alternative<Unknown>(value)) return {"\xe2\x80\x93", {}};
    if (const auto* spread = std::get_if<Spread>(&value))
        return {fmt::format("{} \xc2\xb1 {}", short_number(spread->median), short_number(spread->mad)), number};
    const bool is_whole = is.digits == ".0f";  // what is shown as one ranks as one
    return {cell_text(is, value), is_whole && number ? std::optional(std::round(*number)) : number};
}

std::string window_title(const Described& is) { return is.short_title.empty() ? is.title : is.short_title; }

std::string window_tooltip(const Described& is) {
    const std::string& label = is.label.empty() ? is.title : is.label;
    return is.help.empty() ? label : fmt::format("{}: {}", label, is.help);
}

std::vector<std::size_t> shown_columns(const Sheet& sheet, Place place) {
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < sheet.columns.size(); ++i) {
        const Described& is = sheet.columns[i];
        const auto has_it = [&](const Sheet::Row& row) { return !is_nothing(row.values[i]); };
        if ((is.shown & place) == 0 || (is.if_any && std::ranges::none_of(sheet.rows, has_it))) continue;
        shown.push_back(i);
    }
    return shown;
}

}  // namespace strata
