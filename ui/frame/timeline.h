// The measured frame to scale: a bar per pass and below it a bar per step, one after the other as the device ran them. The wheel
// zooms at the pointer, dragging pans, a double click shows all.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ui/frame/frame_rows.h"
#include "ui/widgets/plot.h"

namespace strata::ui {

/// Measured steps [first, end), and where they lie in the frame.
struct TimelineBar {
    std::size_t first = 0, end = 0;
    Stage stage;
    std::string face, help;
    double from = 0, to = 0;  ///< milliseconds
};

struct Timeline {
    std::vector<TimelineBar> passes, steps;
    double ms = 0;  ///< of all steps: the sum of their medians
};
Timeline timeline_of(const FrameTimes&);

/// The bar at a time, of bars in order without gaps.
const TimelineBar* bar_at(const std::vector<TimelineBar>&, double ms);

// What part of 0..whole is seen after the mouse did something.
AxisRange zoomed(const AxisRange& seen, double whole, double at, double wheel);
AxisRange panned(const AxisRange& seen, double whole, double by);
/// As it is where the bar lies in it.
AxisRange brought_into_sight(const AxisRange& seen, double whole, const TimelineBar&);

struct TimelineMarks {
    std::optional<std::size_t> selected;  ///< a measured step
    bool is_stale = false;                ///< the frame has changed since: drawn paler
};
/// What is seen is kept by the panel; none: all of it. Returns the measured step that was clicked: a pass's last one.
std::optional<std::size_t> draw_timeline(Widgets&, const Timeline&, const TimelineMarks&, std::optional<AxisRange>& seen);

}  // namespace strata::ui
