// What a frame is made of, as tables: a row per draw, light and so on. Values alone, without the frame's texels and vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace strata {

struct Frame;  // capture_format/frame.h

}  // namespace strata

namespace strata::ui {

struct CaptureColumn {
    std::string_view name, help;  ///< with its unit: "range, m"
};

struct CaptureCell {
    std::string text;
    std::optional<double> number = {};  ///< what it is sorted by; none: its text
};

struct CaptureTable {
    std::string_view name, help;
    std::vector<CaptureColumn> columns;  ///< the first is the row's name
    std::vector<std::vector<CaptureCell>> rows;
    std::optional<std::uint32_t> first_draw = {};  ///< where rows are seen in the picture: the first's number in draw_cover()
};

/// Draws, emitters, meshes, materials, textures, lights, blockers, portals, volumes, and what there is one of in a frame.
std::vector<CaptureTable> capture_tables(const Frame&);

/// Indices of the rows of which a cell contains the text, whatever its case; in their order.
std::vector<std::size_t> rows_with(const CaptureTable&, std::string_view text);
enum class SortDirection { up, down };
/// Orders rows by a column; equal ones stay as they are.
void sort_rows(const CaptureTable&, std::size_t column, SortDirection, std::vector<std::size_t>& rows);

}  // namespace strata::ui
