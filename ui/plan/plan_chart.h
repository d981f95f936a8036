// A plan on the screen: a column per step, a row per image or piece of memory. The names of both stay in sight while the cells
// between them are pulled and zoomed. No Dear ImGui context is needed to place it.
#pragma once

#include <optional>

#include "ui/plan/plan_picture.h"
#include "ui/widgets/widgets.h"

namespace strata::ui {

/// What part of a chart is seen.
struct ChartView {
    float zoom = 1;      ///< 1: all columns, as far as they are still wide enough to be clicked
    float x = 0, y = 0;  ///< pixels of the cells that lie left of and above what is seen
    friend bool operator==(const ChartView&, const ChartView&) = default;
};

struct ChartSize {
    std::size_t columns = 0, rows = 0;
    float names = 0;  ///< pixels of the steps' names above the cells
    float alive = 0;  ///< and between both
};

/// A chart in a rectangle of the window.
struct PlanChart {
    ImVec2 from, to;   ///< all of it
    ImVec2 cells;      ///< upper left corner of what is seen of the cells
    ImVec2 origin;     ///< of the first cell: left of and above `cells` where the view was pulled
    float foot = 0;    ///< of the steps' names
    float column = 0;  ///< pixels
    float fit = 0;     ///< of a column at zoom 1
    std::size_t columns = 0, rows = 0;
    static constexpr float row = 19, names = 148;

    float x_of(double step) const { return origin.x + static_cast<float>(step) * column; }
    float y_of(std::size_t index) const { return origin.y + static_cast<float>(index) * row; }
    std::optional<std::size_t> step_at(ImVec2) const;  ///< in the cells or the header above them
    std::optional<std::size_t> row_at(ImVec2) const;   ///< in the cells or the names beside them
};

PlanChart place(const ChartView&, ImVec2 from, ImVec2 size, const ChartSize&);

/// A wheel over the cells zooms columns around the pointer, over the names it scrolls rows.
struct ChartMouse {
    ImVec2 at, pulled = {0, 0};  ///< pulled: since the last frame
    float wheel = 0;
};
ChartView moved(const ChartView&, const PlanChart&, const ChartMouse&);
/// So that a step is in sight.
ChartView shown(const ChartView&, const PlanChart&, std::size_t step);

/// What is marked in a drawing.
struct PlanMarks {
    std::optional<std::size_t> step, row;              ///< selected
    std::optional<std::size_t> step_under, row_under;  ///< under the pointer
};

/// Steps' names over their columns, in the colors of their stages.
void draw_steps(const PlanChart&, const PlanPicture&, const PlanMarks&);
/// Rows are resources (indices into the picture): who writes, who reads, and what flows between them.
void draw_resources(const PlanChart&, const PlanPicture&, const std::vector<std::size_t>& rows, const PlanMarks&);
/// Rows are pieces of memory: who has them, and above them, between `top` and the cells, how much is alive.
void draw_memory(const PlanChart&, const PlanPicture&, const PlanMarks&);
/// As much as the longest name needs, up to a limit. Needs a Dear ImGui context.
float names_height(const std::vector<PlanStep>&);
inline constexpr float alive_height = 58;  ///< of the header below the names

}  // namespace strata::ui
