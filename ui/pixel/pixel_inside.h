// What a technique knows of one pixel: its views there, and of its tables the rows that are about the pixel or its tile.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ui/replayer/live_query.h"

namespace strata::ui {

struct InsideQuestion {
    Request request;
    glm::uvec2 pixel{0};
    const Technique* technique = nullptr;
    friend bool operator==(const InsideQuestion&, const InsideQuestion&) = default;
};

struct InsideValue {
    std::string_view view, unit, help;
    glm::dvec4 value{0};
    bool is_mask = false;  ///< as a table has it whose rows it is the key of
};

/// Rows of a table that are about the pixel.
struct InsideRows {
    const DebugTable* table = nullptr;
    std::string why;  ///< "tile 14" or "mode 3": what the rows have in common with the pixel
    std::vector<std::vector<double>> rows;
    std::string none;  ///< why there is no row
};

struct PixelInside {
    std::vector<InsideValue> values;
    std::vector<InsideRows> tables;
    std::vector<std::string> lights;  ///< names of the frame's lights that the rows mention, by place; others are empty
};

/// A tile of so many pixels a side, counted row by row.
std::uint32_t tile_at(glm::uvec2 pixel, std::uint32_t width, std::uint32_t tile_pixels);
/// The column of a table whose rows are of the value that a view shows; none where it has none.
std::optional<std::size_t> key_column(const Technique&, const DebugTable&, const DebugView&);

/// What a table's column has, as text: masks in hexadecimal, lights with their names.
std::string text_of(const PixelInside&, const TableColumn&, double value);
std::string text_of(const InsideValue&);

Result<PixelInside> inside_of(Session&, Progress&, const InsideQuestion&);

}  // namespace strata::ui
