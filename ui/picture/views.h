// The views of the techniques in use, made small for a gallery, and what belongs to each: tables, the rows of them that are a
// pixel's, parameters, counters of what overflowed.
#pragma once

#include <string>
#include <vector>

#include "replay/session/session.h"
#include "ui/widgets/plot.h"
#include "ui/window/imgui_layer.h"

namespace strata::ui {

/// "stage/technique:view", as Request::outputs has it.
std::string output_name(const Technique&, std::string_view inside);

/// A number of each pixel that is a row's in the technique's tables: its shading mode, its spectrum.
struct PixelNumbers {
    std::string column;
    std::uint32_t width = 0, height = 0;
    std::vector<float> numbers;
    /// Nothing outside, and where the number is below 0.
    std::optional<double> at(glm::ivec2 pixel) const;
};

/// What a technique's views and tables gave.
struct TechniqueViews {
    std::map<std::string, Texels> thumbnails;   ///< by view; a frame may lack some
    std::map<std::string, NumberTable> tables;  ///< by table
    std::vector<PixelNumbers> numbers;
};
/// All of them in one run of the request.
Result<TechniqueViews> views_of(Session&, Request, const Technique&);

/// At most so wide; a texel is the mean of those it stands for, without those that are no numbers.
Texels thumbnail(const HostImage&, std::uint32_t most_width);

/// The views that number their pixels by a column of the technique's tables: those called as the column is, and the one of its
/// shader variants. View and column.
std::vector<std::pair<std::string_view, std::string_view>> numbering_views(const Technique&);

/// A row of a table that a pixel's number leads to.
struct PixelRow {
    std::string_view table;
    const NumberTable* numbers;
    std::size_t row;
};
/// By the column that tells most: where a table has several of them, its first.
std::vector<PixelRow> rows_of_pixel(const TechniqueViews&, glm::ivec2 pixel);

/// The columns of a table over its first one.
std::vector<PlotSeries> curves_of(const NumberTable&);

/// Whether it counts what had no room.
bool counts_overflow(const Counter&);

/// "0x1f" for bits, as few digits as tell it else.
std::string cell_text(const TableColumn&, double);

/// The texels whose first channel is within `half` of `at`; the others are 0.
HostImage slice_of(const HostImage&, double at, double half);

}  // namespace strata::ui
