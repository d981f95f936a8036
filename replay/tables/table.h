// A table for people at a terminal of 120 columns, which it leaves only where its numbers alone are wider.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace strata {

struct Table {
    struct Row {
        std::string marks, label;
        std::vector<std::string> cells;  ///< as many as there are heads, or one that stands for all
    };
    std::vector<std::string> heads;  ///< of the cells; their words are put below each other where that is narrower
    std::vector<Row> rows;
};

/// Labels to the left, cells to the right. A label that would push the cells past column 120 gets a line of its own, and a cell
/// that stands for all is cut there.
std::string as_text(const Table&);

/// Text in lines of at most 120 columns, each with the indent and an end of line, broken at spaces.
std::string wrapped(const std::string& indent, std::string_view text);

/// Three significant digits in at most seven characters, and a sign.
std::string short_number(double);

}  // namespace strata
