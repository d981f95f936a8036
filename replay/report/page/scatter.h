// A scatter plot as SVG: what rows of a report cost and how wrong they are. No device.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace strata {

struct ScatterPoint {
    std::string label;
    std::size_t place = 0;  ///< data-i
    std::size_t kind = 0;   ///< of its color and shape: one for each technique
    double x = 0, y = 0;
    std::optional<double> low_x, high_x;  ///< a bar of what was seen
    bool is_emphasized = false;           ///< its label is bold and placed first
};

struct ScatterPlot {
    std::string x_title, y_title;
    std::vector<ScatterPoint> points;      ///< their numbers are finite; those at or below 0 lie in a strip beside the axis
    std::optional<double> most_x, most_y;  ///< limits: what keeps both has a ground of its own
    double y_floor = 0;                    ///< below it y says nothing: such points lie in the strip, too
    std::string strip_title = "0";         ///< of that strip
    std::string title = {};                ///< drawn above the plot; empty: none
};

/// Both axes are logarithmic. Points have class "pt"; those that no other beats in both
/// figures are filled. Labels meet no point and no other label; a point without room for one has none, and is counted below.
std::string as_svg(const ScatterPlot&);
/// The same as a file of its own: with its colors, of light and dark viewers, and a ground.
std::string as_svg_file(const ScatterPlot&);

/// Shapes and colors of a kind: the drawing of a mark around 0, 0, about 10 wide, and its CSS class, "c3".
std::string mark_path(std::size_t kind);
std::string mark_class(std::size_t kind);

}  // namespace strata
