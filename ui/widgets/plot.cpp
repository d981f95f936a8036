#include "ui/widgets/plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "ui/window/theme.h"

namespace strata::ui {
namespace {

constexpr float point_radius = 4, catch_radius = 12;
constexpr double room = .05;  // beyond the outermost points, of the range

bool can_have(AxisScale scale, double value) { return std::isfinite(value) && (scale == AxisScale::linear || value > 0); }

double bent(AxisScale scale, double value) { return scale == AxisScale::linear ? value : std::log10(value); }
double unbent(AxisScale scale, double value) { return scale == AxisScale::linear ? value : std::pow(10, value); }

std::vector<Tick> linear_ticks(const AxisRange& range, std::size_t most) {
    const double raw = (range.high - range.low) / static_cast<double>(std::max<std::size_t>(1, most));
    const double power = std::pow(10, std::floor(std::log10(raw)));
    double step = 10 * power;
    for (const double times : {1.0, 2.0, 5.0})
        if (times * power >= raw * (1 - 1e-9)) {
            step = times * power;
            break;
        }
    std::vector<Tick> made;
    const double first = std::ceil(range.low / step - 1e-9), last = std::floor(range.high / step + 1e-9);
    for (double i = first; i <= last; ++i) {
        const double value = i == 0 ? 0 : i * step;  // no -0
        made.push_back({value, fmt::format("{:g}", std::abs(value) < step * 1e-9 ? 0 : value)});
    }
    return made;
}

std::vector<Tick> logarithmic_ticks(const AxisRange& range, std::size_t most) {
    const double low = std::floor(std::log10(range.low)), high = std::ceil(std::log10(range.high));
    // Less than a power of ten: the range is as good as linear.
    if (std::log10(range.high / range.low) < 1) return linear_ticks(range, most);
    const double every = std::max(1.0, std::ceil((high - low) / static_cast<double>(std::max<std::size_t>(1, most))));
    std::vector<Tick> made;
    for (double power = low; power <= high; ++power)
        for (int times = 1; times < 10; ++times) {
            const double value = times * std::pow(10, power);
            if (value < range.low * (1 - 1e-9) || value > range.high * (1 + 1e-9)) continue;
            const bool labeled = times == 1 && std::fmod(power - low, every) == 0;
            if (labeled || (every == 1 && high - low <= 6) || times == 1)
                made.push_back({value, labeled ? fmt::format("{:g}", value) : ""});
        }
    return made;
}

/// The plot on the screen.
struct Field {
    ImVec2 from, to;
    AxisRange x, y;
    AxisScale x_scale, y_scale;

    ImVec2 at(glm::dvec2 point) const {
        return {from.x + static_cast<float>(place_in(x, x_scale, point.x)) * (to.x - from.x),
                to.y - static_cast<float>(place_in(y, y_scale, point.y)) * (to.y - from.y)};
    }
    bool has(glm::dvec2 point) const { return can_have(x_scale, point.x) && can_have(y_scale, point.y); }
    bool contains(ImVec2 point) const { return point.x >= from.x && point.x <= to.x && point.y >= from.y && point.y <= to.y; }
};

void draw_ticks(const Plot& plot, const Field& field) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 line = packed({1, 1, 1, .07f}), faint = packed({1, 1, 1, .03f}), text = packed(palette().dim);
    const auto most = [](float pixels, float each) { return static_cast<std::size_t>(std::max(2.0f, pixels / each)); };
    for (const Tick& tick : ticks(field.x, field.x_scale, most(field.to.x - field.from.x, 70))) {
        const float x = std::round(field.at({tick.value, field.y.low}).x);
        list.AddLine({x, field.from.y}, {x, field.to.y}, tick.label.empty() ? faint : line);
        const float width = ImGui::CalcTextSize(tick.label.c_str()).x;
        list.AddText({std::round(x - width / 2), field.to.y + 3}, text, tick.label.c_str());
    }
    for (const Tick& tick : ticks(field.y, field.y_scale, most(field.to.y - field.from.y, 34))) {
        const float y = std::round(field.at({field.x.low, tick.value}).y);
        list.AddLine({field.from.x, y}, {field.to.x, y}, tick.label.empty() ? faint : line);
        const ImVec2 size = ImGui::CalcTextSize(tick.label.c_str());
        list.AddText({field.from.x - size.x - 5, std::round(y - size.y / 2)}, text, tick.label.c_str());
    }
    const float width = ImGui::CalcTextSize(plot.x.label.c_str()).x;
    list.AddText({std::round((field.from.x + field.to.x - width) / 2), field.to.y + 3 + ImGui::GetTextLineHeight()}, text,
                 plot.x.label.c_str());
    list.AddText({field.from.x, field.from.y - ImGui::GetTextLineHeight() - 3}, text, plot.y.label.c_str());
}

void draw_series(const PlotSeries& series, const Field& field) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 color = packed(series.color);
    std::optional<ImVec2> before;
    for (const glm::dvec2& point : series.points) {
        if (!field.has(point)) {
            before.reset();
            continue;
        }
        const ImVec2 at = field.at(point);
        if (series.kind == SeriesKind::scatter) {
            list.AddCircleFilled(at, point_radius, packed(series.color, .85f));
            list.AddCircle(at, point_radius, IM_COL32(0, 0, 0, 160));
        } else if (before && series.kind == SeriesKind::line) {
            list.AddLine(*before, at, color, 1.5f);
        } else if (before) {
            list.AddLine(*before, {at.x, before->y}, color, 1.5f);
            list.AddLine({at.x, before->y}, at, color, 1.5f);
        }
        before = at;
    }
    // A step's last value goes on to the edge.
    if (series.kind == SeriesKind::step && before) list.AddLine(*before, {field.to.x, before->y}, color, 1.5f);
}

void draw_spreads(const PlotSeries& series, const Field& field) {
    constexpr float cap = 3;
    const ImU32 color = packed(series.color, .7f);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (std::size_t i = 0; i < series.spreads.size(); ++i) {
        const glm::dvec2 point = series.points[i];
        if (!field.has(point) || series.spreads[i] <= 0) continue;
        // A logarithmic axis has no place for what the spread leaves of a small time: the bar ends at the edge.
        const ImVec2 from = field.at({std::max(field.x.low, point.x - series.spreads[i]), point.y});
        const ImVec2 to = field.at({point.x + series.spreads[i], point.y});
        list.AddLine(from, to, color, 1.5f);
        list.AddLine({from.x, from.y - cap}, {from.x, from.y + cap}, color);
        list.AddLine({to.x, to.y - cap}, {to.x, to.y + cap}, color);
    }
}

/// What can be hovered and clicked, for scripts.
void record_points(Widgets& widgets, const PlotSeries& series, const Field& field) {
    const auto points = widgets.in("points");
    const auto scope = widgets.in(series.label);
    for (std::size_t i = 0; i < series.points.size(); ++i)
        if (field.has(series.points[i]) && field.contains(field.at(series.points[i])))
            widgets.point(fmt::format("{}", i), field.at(series.points[i]), i < series.notes.size() ? series.notes[i] : "");
}

void draw_ring(const PlotSeries& series, std::size_t point, const Field& field) {
    if (!field.has(series.points[point])) return;
    ImGui::GetWindowDrawList()->AddCircle(field.at(series.points[point]), point_radius + 3, packed(palette().text), 0, 1.5f);
}

/// The point nearest to the mouse, of those it can mean.
std::optional<PlotPoint> nearest(std::span<const PlotSeries> all, const PlotView& view, const Field& field, ImVec2 mouse) {
    std::optional<PlotPoint> best;
    float least = catch_radius * catch_radius;
    for (std::size_t s = 0; s < all.size(); ++s) {
        if (view.hidden.contains(all[s].label)) continue;
        for (std::size_t p = 0; p < all[s].points.size(); ++p) {
            if (!field.has(all[s].points[p])) continue;
            const ImVec2 at = field.at(all[s].points[p]);
            const float distance = (at.x - mouse.x) * (at.x - mouse.x) + (at.y - mouse.y) * (at.y - mouse.y);
            if (distance >= least) continue;
            least = distance;
            best = {s, p};
        }
    }
    return best;
}

void show_values(const Plot& plot, const PlotSeries& series, std::size_t point, const Field& field) {
    draw_ring(series, point, field);
    ImGui::BeginTooltip();
    ImGui::TextColored(series.color, "%s", series.label.c_str());
    if (point < series.notes.size() && !series.notes[point].empty()) ImGui::TextUnformatted(series.notes[point].c_str());
    ImGui::TextUnformatted(
        fmt::format("{:.5g} {}\n{:.5g} {}", series.points[point].x, plot.x.label, series.points[point].y, plot.y.label).c_str());
    ImGui::EndTooltip();
}

/// Drag pans, the wheel zooms to the pointer, a double click shows everything again.
void take_mouse(PlotView& view, const Field& field) {
    const ImGuiIO& io = ImGui::GetIO();
    const auto moved = [](const AxisRange& range, AxisScale scale, double by_low, double by_high) {
        return AxisRange{value_at(range, scale, by_low), value_at(range, scale, by_high)};
    };
    const double wide = double{field.to.x - field.from.x}, high = double{field.to.y - field.from.y};
    if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 3)) {
        const double x = -double{io.MouseDelta.x} / wide, y = double{io.MouseDelta.y} / high;
        view.x = moved(field.x, field.x_scale, x, 1 + x);
        view.y = moved(field.y, field.y_scale, y, 1 + y);
    }
    if (ImGui::IsItemHovered() && io.MouseWheel != 0) {
        const double factor = std::pow(1.2, -double{io.MouseWheel});
        const double x = double{io.MousePos.x - field.from.x} / wide, y = double{field.to.y - io.MousePos.y} / high;
        view.x = moved(field.x, field.x_scale, x - x * factor, x + (1 - x) * factor);
        view.y = moved(field.y, field.y_scale, y - y * factor, y + (1 - y) * factor);
    }
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        view.x.reset();
        view.y.reset();
    }
}

void draw_legend(Widgets& widgets, std::span<const PlotSeries> all, PlotView& view) {
    const auto scope = widgets.in("legend");
    const ImGuiStyle& style = ImGui::GetStyle();
    const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    float ends = 0;  // the button before
    for (const PlotSeries& series : all) {
        const bool hidden = view.hidden.contains(series.label);
        ImGui::PushStyleColor(ImGuiCol_Text, hidden ? palette().dim : series.color);
        const std::string face = fmt::format("{} {}", hidden ? "\xe2\x97\x8b" : "\xe2\x97\x8f", series.label);
        const float width = ImGui::CalcTextSize(face.c_str()).x + 2 * style.FramePadding.x;
        if (ends > 0 && ends + style.ItemSpacing.x + width <= right) ImGui::SameLine();
        const bool pressed = widgets.button(series.label, face);
        ends = ImGui::GetItemRectMax().x;
        ImGui::PopStyleColor();
        if (!pressed) continue;
        if (hidden) view.hidden.erase(series.label);
        else view.hidden.insert(series.label);
    }
}

}  // namespace

double place_in(const AxisRange& range, AxisScale scale, double value) {
    const double low = bent(scale, range.low), high = bent(scale, range.high);
    return (bent(scale, value) - low) / (high - low);
}

double value_at(const AxisRange& range, AxisScale scale, double place) {
    const double low = bent(scale, range.low), high = bent(scale, range.high);
    return unbent(scale, low + place * (high - low));
}

std::vector<Tick> ticks(const AxisRange& range, AxisScale scale, std::size_t most) {
    return scale == AxisScale::linear ? linear_ticks(range, most) : logarithmic_ticks(range, most);
}

AxisRange range_of(std::span<const PlotSeries> all, const PlotView& view, int axis, AxisScale scale) {
    std::optional<AxisRange> range;
    for (const PlotSeries& series : all) {
        if (view.hidden.contains(series.label)) continue;
        for (const glm::dvec2& point : series.points) {
            const double value = point[axis];
            if (!can_have(scale, value)) continue;
            range = range ? AxisRange{std::min(range->low, value), std::max(range->high, value)} : AxisRange{value, value};
        }
    }
    if (!range) return scale == AxisScale::linear ? AxisRange{0, 1} : AxisRange{.1, 10};
    double low = bent(scale, range->low), high = bent(scale, range->high);
    if (low == high) {
        low -= .5;
        high += .5;
    }
    const double more = (high - low) * room;
    return {unbent(scale, low - more), unbent(scale, high + more)};
}

PlotEvent draw_plot(Widgets& widgets, const Plot& plot, std::span<const PlotSeries> all, PlotView& view) {
    const auto scope = widgets.in(plot.label);
    draw_legend(widgets, all, view);
    widgets.canvas("field", plot.size, fmt::format("{} over {}", plot.y.label, plot.x.label));
    const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
    const float line = ImGui::GetTextLineHeight();
    Field field{{from.x + 58, from.y + line + 6}, {to.x - 8, to.y - 2 * line - 6}, {}, {}, plot.x.scale, plot.y.scale};
    field.x = view.x.value_or(range_of(all, view, 0, plot.x.scale));
    field.y = view.y.value_or(range_of(all, view, 1, plot.y.scale));
    take_mouse(view, field);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(field.from, field.to, packed({0, 0, 0, .25f}), 2);
    draw_ticks(plot, field);
    list.PushClipRect(field.from, field.to, true);
    for (const PlotSeries& series : all) {
        if (view.hidden.contains(series.label)) continue;
        draw_spreads(series, field);
        draw_series(series, field);
        if (series.kind == SeriesKind::scatter) record_points(widgets, series, field);
    }
    if (plot.marked) draw_ring(all[plot.marked->series], plot.marked->point, field);
    list.PopClipRect();

    PlotEvent event;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (!ImGui::IsItemHovered() || !field.contains(mouse)) return event;
    event.under = nearest(all, view, field, mouse);
    if (!event.under) return event;
    show_values(plot, all[event.under->series], event.under->point, field);
    const bool is_click = ImGui::IsMouseReleased(ImGuiMouseButton_Left) && ImGui::GetIO().MouseDragMaxDistanceSqr[0] < 9;
    if (is_click) event.clicked = event.under;
    return event;
}

}  // namespace strata::ui
