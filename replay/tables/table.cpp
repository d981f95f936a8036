#include "replay/tables/table.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/core.h>

namespace strata {
namespace {

constexpr std::size_t columns = 120, marks_width = 3, head_width = 9;

/// The words of a head in lines of at most head_width characters.
std::vector<std::string> lines_of(const std::string& head) {
    std::vector<std::string> lines;
    std::istringstream words(head);
    for (std::string word; words >> word;)
        if (!lines.empty() && lines.back().size() + 1 + word.size() <= head_width) lines.back() += " " + word;
        else lines.push_back(word);
    return lines;
}

std::size_t longest(const std::vector<std::string>& texts) {
    std::size_t most = 0;
    for (const std::string& text : texts) most = std::max(most, text.size());
    return most;
}

/// Every column's heads and widths.
struct Layout {
    explicit Layout(const Table& table) {
        std::size_t cells = 0;
        for (std::size_t i = 0; i < table.heads.size(); ++i) {
            heads.push_back(lines_of(table.heads[i]));
            height = std::max(height, heads.back().size());
            widths.push_back(longest(heads.back()));
            for (const Table::Row& row : table.rows)
                if (row.cells.size() == table.heads.size()) widths.back() = std::max(widths.back(), row.cells[i].size());
            cells += 1 + widths.back();
        }
        for (const Table::Row& row : table.rows) label = std::max(label, row.label.size());
        if (marks_width + label + cells + widths.size() <= columns) {  // heads of several words then do not run together
            gap = 2;
            cells += widths.size();
        }
        label = std::clamp<std::size_t>(label, 1, columns - std::min(columns - 1, marks_width + cells));
    }
    std::vector<std::vector<std::string>> heads;
    std::vector<std::size_t> widths;
    std::size_t height = 0, label = 0, gap = 1;

    /// A cell with the gap before it.
    std::string cell(std::size_t column, std::string_view text) const {
        return fmt::format("{:>{}}", text, gap + widths[column]);
    }
};

std::string without_spaces_at_the_end(std::string line) {
    line.erase(line.find_last_not_of(' ') + 1);
    return line + "\n";
}

}  // namespace

std::string as_text(const Table& table) {
    const Layout layout(table);
    std::string text;
    for (std::size_t line = 0; line < layout.height; ++line) {
        std::string heads(marks_width + layout.label, ' ');
        for (std::size_t i = 0; i < layout.heads.size(); ++i) {
            const std::vector<std::string>& lines = layout.heads[i];
            const std::size_t above = layout.height - lines.size();  // heads stand on the last line
            heads += layout.cell(i, line < above ? "" : lines[line - above]);
        }
        text += without_spaces_at_the_end(heads);
    }
    for (const Table::Row& row : table.rows) {
        std::string line = fmt::format("{:<{}}{:<{}}", row.marks, marks_width, row.label, layout.label);
        if (row.label.size() > layout.label) {
            text += without_spaces_at_the_end(line);
            line = std::string(marks_width + layout.label, ' ');
        }
        const bool is_sentence = row.cells.size() != layout.widths.size();  // numbers are never cut
        for (std::size_t i = 0; i < row.cells.size(); ++i)
            line += is_sentence ? " " + row.cells[i] : layout.cell(i, row.cells[i]);
        if (is_sentence && line.size() > columns) line.replace(columns - 3, std::string::npos, "...");
        text += without_spaces_at_the_end(line);
    }
    return text;
}

std::string wrapped(const std::string& indent, std::string_view text) {
    std::string lines;
    while (!text.empty()) {
        const std::size_t room = columns - indent.size();
        const std::size_t space = text.size() <= room ? text.size() : text.rfind(' ', room);
        const std::size_t end = space == text.npos ? room : space;
        lines += indent + std::string(text.substr(0, end)) + "\n";
        text.remove_prefix(std::min(text.size(), text.find_first_not_of(' ', end)));
    }
    return lines;
}

std::string short_number(double value) {
    const double size = std::abs(value);
    if (size != 0 && (size < 1e-3 || size >= 1e5)) return fmt::format("{:.1e}", value);
    return size >= 100 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

}  // namespace strata
