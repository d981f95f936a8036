#include "ui/plan/plan_chart.h"

#include <algorithm>
#include <cmath>

namespace strata::ui {
namespace {

// Narrower columns are hard to click; wider ones than these show no more at first sight.
constexpr float least_column = 12, widest_fit = 30, most_zoom = 12;
// Names lean over the columns after theirs, by 60 degrees.
constexpr float lean = .58f;

// Whole pixels, so that all columns are of one width.
float column_of(float fit, float zoom) { return std::floor(fit * zoom); }

float visible_width(const PlanChart& chart) {
    return std::max(1.0f, chart.to.x - chart.cells.x - lean * (chart.foot - chart.from.y));
}

/// Neither further than the ends of the cells, nor away from where they all fit.
ChartView clamped(ChartView view, const PlanChart& chart) {
    const float wide = static_cast<float>(chart.columns) * chart.column - visible_width(chart);
    const float high = static_cast<float>(chart.rows) * PlanChart::row - (chart.to.y - chart.cells.y);
    view.x = std::clamp(view.x, 0.0f, std::max(0.0f, wide));
    view.y = std::clamp(view.y, 0.0f, std::max(0.0f, high));
    return view;
}

}  // namespace

PlanChart place(const ChartView& view, ImVec2 from, ImVec2 size, const ChartSize& cells) {
    PlanChart chart{.from = from, .to = {from.x + size.x, from.y + size.y}, .columns = cells.columns, .rows = cells.rows};
    chart.foot = from.y + cells.names;
    chart.cells = {from.x + PlanChart::names, chart.foot + cells.alive};
    const float fit = visible_width(chart) / static_cast<float>(std::max<std::size_t>(cells.columns, 1));
    chart.fit = std::clamp(fit, least_column, widest_fit);
    chart.column = column_of(chart.fit, view.zoom);
    const ChartView seen = clamped(view, chart);
    chart.origin = {chart.cells.x - seen.x, chart.cells.y - seen.y};
    return chart;
}

std::optional<std::size_t> PlanChart::step_at(ImVec2 point) const {
    if (point.x < cells.x || point.x >= to.x || point.y < from.y || point.y >= to.y) return {};
    const float step = std::floor((point.x - origin.x) / column);
    return step >= 0 && step < static_cast<float>(columns) ? std::optional(static_cast<std::size_t>(step)) : std::nullopt;
}

std::optional<std::size_t> PlanChart::row_at(ImVec2 point) const {
    if (point.x < from.x || point.x >= to.x || point.y < cells.y || point.y >= to.y) return {};
    const float index = std::floor((point.y - origin.y) / row);
    return index >= 0 && index < static_cast<float>(rows) ? std::optional(static_cast<std::size_t>(index)) : std::nullopt;
}

ChartView moved(const ChartView& view, const PlanChart& chart, const ChartMouse& mouse) {
    ChartView now = clamped(view, chart);
    now.x -= mouse.pulled.x;
    now.y -= mouse.pulled.y;
    if (mouse.wheel != 0 && mouse.at.x < chart.cells.x) now.y -= mouse.wheel * 3 * PlanChart::row;
    PlanChart after = chart;
    if (mouse.wheel != 0 && mouse.at.x >= chart.cells.x) {
        now.zoom = std::clamp(view.zoom * std::pow(1.25f, mouse.wheel), 1.0f, most_zoom);
        after.column = column_of(chart.fit, now.zoom);
        const float under = (mouse.at.x - chart.origin.x) / chart.column;  // columns
        now.x = under * after.column - (mouse.at.x - chart.cells.x);
    }
    return clamped(now, after);
}

ChartView shown(const ChartView& view, const PlanChart& chart, std::size_t step) {
    ChartView now = clamped(view, chart);
    const float left = static_cast<float>(step) * chart.column, right = left + chart.column;
    if (left < now.x) now.x = left;
    if (right > now.x + visible_width(chart)) now.x = right - visible_width(chart);
    return clamped(now, chart);
}

}  // namespace strata::ui
