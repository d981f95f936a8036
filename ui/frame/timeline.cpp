#include "ui/frame/timeline.h"

#include <algorithm>
#include <cmath>

#include "replay/plural.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

constexpr float pass_height = 18, step_height = 16, axis_height = 16;
// Closer than this nobody measures anything.
constexpr double least_share = 1e-3;

AxisRange within(AxisRange seen, double whole) {
    const double wide = std::min(seen.high - seen.low, whole);
    seen.low = std::clamp(seen.low, 0.0, whole - wide);
    return {seen.low, seen.low + wide};
}

std::string help_of(std::string_view name, const Spread& ms, double frame_ms) {
    return fmt::format("{}\n{} ms, {:.1f} % of the frame", name, time_text(ms), 100 * ms.median / std::max(ms.median, frame_ms));
}

/// Milliseconds on the screen.
struct Lane {
    ImVec2 from, to;
    AxisRange seen;
    float x_of(double ms) const { return from.x + (to.x - from.x) * static_cast<float>(place_in(seen, AxisScale::linear, ms)); }
    double ms_at(float x) const { return value_at(seen, AxisScale::linear, double{x - from.x} / double{to.x - from.x}); }
};

void draw_bar(const Lane& lane, const TimelineBar& bar, float top, float bottom, float alpha, bool is_marked) {
    const float left = lane.x_of(bar.from), right = lane.x_of(bar.to);
    if (right < lane.from.x || left > lane.to.x) return;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec4 color = color_of_stage(static_cast<std::size_t>(bar.stage));
    // A gap tells neighbors apart where there is room for one; what is too short to be seen is a line.
    const float gap = right - left > 4 ? 1.0f : 0.0f;
    const ImVec2 from(left, top), to(std::max(left + 1, right - gap), bottom);
    list.AddRectFilled(from, to, packed(color, alpha));
    if (is_marked) list.AddRect({from.x - 1, from.y}, {to.x + 1, to.y}, packed(palette().text), 0, 0, 2);
    const float room = std::min(to.x, lane.to.x) - std::max(from.x, lane.from.x) - 6;
    if (room < 20) return;
    list.PushClipRect(from, {to.x - 2, to.y}, true);
    const float y = (top + bottom - ImGui::GetTextLineHeight()) / 2;
    list.AddText({std::max(from.x, lane.from.x) + 3, y}, packed({0, 0, 0, 1}, .85f), bar.face.c_str());
    list.PopClipRect();
}

void draw_axis(const Lane& lane) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float top = lane.to.y - axis_height;
    float free = lane.from.x;
    for (const Tick& tick : ticks(lane.seen, AxisScale::linear, 4)) {
        const float x = lane.x_of(tick.value);
        list.AddLine({x, top}, {x, top + 3}, packed(palette().dim));
        const std::string text = tick.label.empty() ? "" : fmt::format("{} ms", tick.label);
        const float end = x + 2 + ImGui::CalcTextSize(text.c_str()).x;
        if (text.empty() || x < free || end > lane.to.x) continue;
        list.AddText({x + 2, top + 1}, packed(palette().dim), text.c_str());
        free = end + 8;
    }
}

void take_mouse(const Lane& lane, double whole, std::optional<AxisRange>& seen) {
    const ImGuiIO& io = ImGui::GetIO();
    AxisRange now = lane.seen;
    if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 3))
        now = panned(now, whole, lane.ms_at(io.MousePos.x - io.MouseDelta.x) - lane.ms_at(io.MousePos.x));
    if (ImGui::IsItemHovered() && io.MouseWheel != 0) now = zoomed(now, whole, lane.ms_at(io.MousePos.x), double{io.MouseWheel});
    if (!(now == lane.seen)) seen = now;
    const bool shows_all = seen && seen->high - seen->low >= whole;
    if (shows_all || (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))) seen.reset();
}

}  // namespace

Timeline timeline_of(const FrameTimes& times) {
    Timeline made;
    const std::vector<StepRecord>& steps = times.run.steps;
    const double frame_ms = times.run.frame_ms ? times.run.frame_ms->median : 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (!steps[i].ms) continue;
        const double from = made.ms;
        made.ms += steps[i].ms->median;
        made.steps.push_back({i, i + 1, steps[i].scope.stage, short_name(steps[i].name),
                              help_of(fmt::format("{}\n{}", steps[i].name, text_of(steps[i].scope)), *steps[i].ms, frame_ms),
                              from, made.ms});
        if (made.passes.empty() || steps[made.passes.back().first].scope != steps[i].scope)
            made.passes.push_back({i, i, steps[i].scope.stage, face_of(steps[i].scope), {}, from, from});
        made.passes.back().end = i + 1;
        made.passes.back().to = made.ms;
    }
    for (TimelineBar& pass : made.passes)
        pass.help = fmt::format("{}\n{}", help_of(pass.face, *spread_of_sum(steps, pass.first, pass.end), frame_ms),
                                plural(pass.end - pass.first, "step"));
    return made;
}

const TimelineBar* bar_at(const std::vector<TimelineBar>& bars, double ms) {
    const auto after = std::ranges::upper_bound(bars, ms, {}, &TimelineBar::to);
    return after == bars.end() || ms < after->from ? nullptr : &*after;
}

AxisRange zoomed(const AxisRange& seen, double whole, double at, double wheel) {
    const double wide = seen.high - seen.low;
    const double now = std::clamp(wide * std::pow(1.25, -wheel), whole * least_share, whole);
    const double low = at - (at - seen.low) * now / wide;
    return within({low, low + now}, whole);
}

AxisRange panned(const AxisRange& seen, double whole, double by) { return within({seen.low + by, seen.high + by}, whole); }

AxisRange brought_into_sight(const AxisRange& seen, double whole, const TimelineBar& bar) {
    if (bar.from >= seen.low && bar.to <= seen.high) return seen;
    const double middle = (bar.from + bar.to) / 2, half = std::max(seen.high - seen.low, bar.to - bar.from) / 2;
    return within({middle - half, middle + half}, whole);
}

std::optional<std::size_t> draw_timeline(Widgets& widgets, const Timeline& timeline, const TimelineMarks& marks,
                                         std::optional<AxisRange>& seen) {
    const AxisRange all{0, timeline.ms};
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImVec2 size(std::max(40.0f, ImGui::GetContentRegionAvail().x), pass_height + step_height + axis_height + 3);
    Lane lane{from, {from.x + size.x, from.y + size.y}, seen.value_or(all)};
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const float steps_top = from.y + pass_height + 1;
    const auto bar_under = [&]() -> const TimelineBar* {
        if (mouse.x < lane.from.x || mouse.x >= lane.to.x || mouse.y < from.y || mouse.y >= lane.to.y - axis_height)
            return nullptr;
        return bar_at(mouse.y < steps_top ? timeline.passes : timeline.steps, lane.ms_at(mouse.x));
    };
    const TimelineBar* under = bar_under();
    widgets.canvas("timeline", size,
                   fmt::format("{:.2f} to {:.2f} of {:.2f} ms{}{}", lane.seen.low, lane.seen.high, timeline.ms, under ? "; " : "",
                               under ? under->help : ""));
    take_mouse(lane, timeline.ms, seen);
    lane.seen = seen.value_or(all);

    const float alpha = marks.is_stale ? .35f : .85f;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(lane.from, {lane.to.x, lane.to.y - axis_height}, packed({0, 0, 0, .25f}));
    list.PushClipRect(lane.from, lane.to, true);
    const auto draw = [&](const std::vector<TimelineBar>& bars, float top, float height) {
        for (const TimelineBar& bar : bars)
            draw_bar(lane, bar, top, top + height, std::min(1.0f, alpha + (&bar == under ? .15f : 0)), false);
        for (const TimelineBar& bar : bars)
            if (marks.selected && bar.first <= *marks.selected && *marks.selected < bar.end)
                draw_bar(lane, bar, top, top + height, alpha, true);
    };
    draw(timeline.passes, from.y, pass_height);
    draw(timeline.steps, steps_top, step_height);
    draw_axis(lane);
    list.PopClipRect();
    if (under) widgets.help(under->help);
    const bool is_click = ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(ImGuiMouseButton_Left) &&
                          ImGui::GetIO().MouseDragMaxDistanceSqr[0] < 9;
    if (!is_click || !under) return {};
    return under->end - 1;
}

}  // namespace strata::ui
