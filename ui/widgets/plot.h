// Plots: lines, steps and points over linear or logarithmic axes, with a legend that switches series off, the nearest point's
// values under the mouse, and the mouse to pan and zoom. Dear ImGui has none.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "ui/widgets/widgets.h"

namespace strata::ui {

enum class AxisScale { linear, logarithmic };

struct PlotAxis {
    std::string label;
    AxisScale scale = AxisScale::linear;
};

/// From low to high, of the values themselves; low is above 0 on a logarithmic axis.
struct AxisRange {
    double low = 0, high = 1;
    friend bool operator==(const AxisRange&, const AxisRange&) = default;
};

/// Where a value lies in the range: 0 at its low, 1 at its high end.
double place_in(const AxisRange&, AxisScale, double value);
/// The value at a place.
double value_at(const AxisRange&, AxisScale, double place);

struct Tick {
    double value = 0;
    std::string label;  ///< empty: a line without a number
};
/// Round numbers in the range, at most so many of them labeled: 1, 2 or 5 times a power of ten apart, or the powers of ten
/// themselves.
std::vector<Tick> ticks(const AxisRange&, AxisScale, std::size_t most);

enum class SeriesKind { line, step, scatter };

struct PlotSeries {
    std::string label;
    SeriesKind kind = SeriesKind::line;
    std::vector<glm::dvec2> points;  ///< a line's and a step's in the order of x; a value stays until the next x
    ImVec4 color = {1, 1, 1, 1};
    std::vector<std::string> notes = {};  ///< shown with a point that the mouse is on; none, or as many as points
    std::vector<double> spreads = {};     ///< half the length of a bar along x through each point; none, or as many as points
};

/// What the mouse made of a plot: kept by the panel.
struct PlotView {
    std::optional<AxisRange> x, y;  ///< none: as the points need
    std::set<std::string> hidden;   ///< series that are switched off
};

struct PlotPoint {
    std::size_t series = 0, point = 0;
    friend bool operator==(const PlotPoint&, const PlotPoint&) = default;
};
struct PlotEvent {
    std::optional<PlotPoint> under, clicked;
};

/// The range of all shown points with some room around it. Points that a logarithmic axis cannot have do not count.
AxisRange range_of(std::span<const PlotSeries>, const PlotView&, int axis, AxisScale);

struct Plot {
    std::string_view label;  ///< its part of the widgets' path
    PlotAxis x, y;
    ImVec2 size;
    std::optional<PlotPoint> marked = {};  ///< drawn with a ring, as under the mouse
};
PlotEvent draw_plot(Widgets&, const Plot&, std::span<const PlotSeries>, PlotView&);

}  // namespace strata::ui
