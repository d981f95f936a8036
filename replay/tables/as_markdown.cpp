// Sheets as Markdown, for pull requests and documents.
#include <algorithm>

#include <fmt/format.h>

#include "replay/tables/shown_columns.h"

namespace strata {
namespace {

/// Text in a cell: a bar would end it, a line's end the row.
std::string in_a_cell(std::string_view text) {
    std::string safe;
    for (const char c : text) {
        if (c == '|' || c == '\\' || c == '*' || c == '_' || c == '<' || c == '`') safe += '\\';
        safe += c == '\n' ? ' ' : c;
    }
    return safe;
}

/// Markdown in a cell, where a bar alone needs care.
std::string with_bars_escaped(std::string_view text) {
    std::string safe;
    for (const char c : text) safe += c == '|' ? std::string("\\|") : std::string(1, c);
    return safe;
}

bool is_text(const Described& is) { return is.kind == CellKind::text; }

/// One fence more than the longest in the text.
std::string fenced(std::string_view text) {
    std::size_t longest = 2, now = 0;
    for (const char c : text) {
        now = c == '`' ? now + 1 : 0;
        longest = std::max(longest, now);
    }
    const std::string fence(longest + 1, '`');
    const std::size_t first = text.find_first_not_of('\n'), last = text.find_last_not_of('\n');
    if (first == text.npos) return "";
    return fmt::format("{0}\n{1}\n{0}\n\n", fence, text.substr(first, last - first + 1));
}

}  // namespace

std::string as_markdown(const Sheet& sheet) {
    const std::vector<std::size_t> shown = shown_columns(sheet, in_text);
    const bool has_marks = std::ranges::any_of(
        sheet.rows, [](const Sheet::Row& row) { return row.name.marks.find_first_not_of(' ') != std::string::npos; });
    std::string heads = fmt::format("|{} {} |", has_marks ? "  |" : "", in_a_cell(sheet.heads_labels));
    std::string rule = has_marks ? "|---|---|" : "|---|";
    for (const std::size_t column : shown) {
        heads += fmt::format(" {} |", in_a_cell(sheet.columns[column].title));
        rule += is_text(sheet.columns[column]) ? "---|" : "---:|";
    }
    std::string text = heads + "\n" + rule + "\n";
    for (const Sheet::Row& row : sheet.rows) {
        text += has_marks ? fmt::format("| {} |", in_a_cell(row.name.marks)) : "|";
        text += fmt::format(" {} |", in_a_cell(row.name.label));
        if (!row.name.instead.empty()) text += fmt::format(" {} |", in_a_cell(row.name.instead));
        else
            for (const std::size_t column : shown)
                text += fmt::format(" {} |", in_a_cell(cell_text(sheet.columns[column], row.values[column])));
        text += "\n";
    }
    return text;
}

std::string as_markdown(const Page& page) {
    std::string text;
    for (const auto& part : page) {
        if (const auto* words = std::get_if<std::string>(&part)) text += fenced(*words);
        else if (const auto* lines = std::get_if<Lines>(&part)) text += as_markdown(lines->sheet) + "\n";
        else text += as_markdown(std::get<Sheet>(part)) + "\n";
    }
    if (!text.empty()) text.pop_back();  // the last empty line
    return text;
}

std::string columns_markdown(const Sheet& sheet, DocumentedBy by) {
    const bool by_title = by == DocumentedBy::title;
    std::string text = by_title ? "| column | meaning |\n|---|---|\n" : "| key | meaning |\n|---|---|\n";
    for (const Described& is : sheet.columns) {
        if ((is.shown & (by_title ? in_text : in_files)) == 0) continue;
        std::string name = by_title ? in_a_cell(is.title) : fmt::format("`{}`", is.key);
        if (!by_title && !is.json.empty()) name += fmt::format(", JSON `{}`", is.json.substr(1));
        if (!by_title && (is.shown & in_files) != in_files) name += is.shown & in_json ? ", JSON only" : ", CSV only";
        const bool has_unit = !by_title && !is.unit.empty();
        text += fmt::format("| {} | {}{} |\n", name, with_bars_escaped(is.help), has_unit ? fmt::format(" ({})", is.unit) : "");
    }
    return text;
}

}  // namespace strata
