#include "ui/picture/outline.h"

#include <algorithm>
#include <cmath>

#include "ui/window/theme.h"

namespace strata::ui {
namespace {

/// Edges between a pixel that is in and a neighbor that is not, in runs as long as they go.
template <typename IsIn>
std::vector<OutlineLine> edges(std::uint32_t width, std::uint32_t height, IsIn is_in) {
    const auto in = [&](std::uint32_t x, std::uint32_t y) { return x < width && y < height && is_in(x, y); };
    std::vector<OutlineLine> lines;
    // One less than 0 is beyond the width and the height, too.
    for (std::uint32_t y = 0; y <= height; ++y)
        for (std::uint32_t x = 0, begin = 0; x <= width; ++x) {
            const bool is_edge = x < width && in(x, y) != in(x, y - 1);
            if (!is_edge && begin < x) lines.push_back({begin, y, x, y});
            if (!is_edge) begin = x + 1;
        }
    for (std::uint32_t x = 0; x <= width; ++x)
        for (std::uint32_t y = 0, begin = 0; y <= height; ++y) {
            const bool is_edge = y < height && in(x, y) != in(x - 1, y);
            if (!is_edge && begin < y) lines.push_back({x, begin, x, y});
            if (!is_edge) begin = y + 1;
        }
    return lines;
}

void draw_lines(const Placement& placement, const Outline& outline, const std::vector<OutlineLine>& lines, ImU32 color) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const double across = static_cast<double>(placement.width) / outline.width,
                 down = static_cast<double>(placement.height) / outline.height;
    for (const OutlineLine& line : lines) {
        const ImVec2 from = placement.on_screen(line.x0 * across, line.y0 * down),
                     to = placement.on_screen(line.x1 * across, line.y1 * down);
        const bool is_in_sight =
            to.x >= placement.from.x && from.x <= placement.to.x && to.y >= placement.from.y && from.y <= placement.to.y;
        // Rectangles: a draw list's lines are three times as many vertices.
        if (is_in_sight) list.AddRectFilled({from.x - 1, from.y - 1}, {to.x + 1, to.y + 1}, color);
    }
}

}  // namespace

Outline outline_of(std::span<const Cover> cover, std::uint32_t width) {
    const auto height = static_cast<std::uint32_t>(cover.size() / std::max(width, 1u));
    Outline outline{.width = width, .height = height, .from = {width, height}};
    const auto at = [&](std::uint32_t x, std::uint32_t y) { return cover[std::size_t(y) * width + x]; };
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            if (at(x, y) == Cover::none) continue;
            ++(at(x, y) == Cover::shown ? outline.shown : outline.hidden);
            outline.from = glm::min(outline.from, glm::uvec2(x, y));
            outline.to = glm::max(outline.to, glm::uvec2(x, y) + 1u);
        }
    outline.around_shown = edges(width, height, [&](auto x, auto y) { return at(x, y) == Cover::shown; });
    outline.around_all = edges(width, height, [&](auto x, auto y) { return at(x, y) != Cover::none; });
    return outline;
}

void draw_outline(const Placement& placement, const Outline& outline, const Request& request) {
    if (outline.request.variant.frame != request.variant.frame || outline.request.variant.eye != request.variant.eye) return;
    // Maps, volumes and tables are no pictures of the view; at lower resolution these differ by a row of texels.
    const double shape =
        static_cast<double>(placement.width) * outline.height / std::max(1.0, double(placement.height) * outline.width);
    if (std::abs(shape - 1) > .02) return;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(placement.from, placement.to, true);
    draw_lines(placement, outline, outline.around_all, packed({0, 0, 0, 1}, .45f));
    draw_lines(placement, outline, outline.around_shown, packed(palette().warning));
    list.PopClipRect();
}

}  // namespace strata::ui
