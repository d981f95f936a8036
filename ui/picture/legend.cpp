#include "ui/picture/legend.h"

#include <algorithm>
#include <cmath>

#include "ui/picture/look_bytes.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

const ImVec2 ramp_size(180, 10);

}  // namespace

LookEnds ends_of(const Look& look, std::string_view unit) {
    const double unexposed = std::exp2(-double{look.exposure});
    const auto text = [&](float value) {
        return fmt::format("{:.4g}{}{}", double{value} * unexposed, unit.empty() ? "" : " ", unit);
    };
    return {text(look.black), text(look.white)};
}

void draw_ramp(ImVec2 from, ImVec2 to, const Look& look) {
    constexpr int steps = 60;
    Look plain = look;
    plain.exposure = 0;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (int i = 0; i < steps; ++i) {
        const auto begin = static_cast<float>(i) / steps, end = static_cast<float>(i + 1) / steps;
        const double value = double{look.black} + (i + .5) / steps * double{look.white - look.black};
        list.AddRectFilled({from.x + begin * (to.x - from.x), from.y}, {from.x + end * (to.x - from.x), to.y},
                           shown_color(plain, glm::dvec4(value)));
    }
}

void draw_legend_over(Widgets& widgets, const Placement& placement, const Look& look, std::string_view image) {
    const DebugView* view = find_view(std::string(image));
    const bool has_unit = view && !view->unit.empty() && look.channels != Channels::color;
    if (look.channels != Channels::false_color && !has_unit) return;
    const LookEnds ends = ends_of(look, view ? view->unit : "");
    const float line = ImGui::GetTextLineHeight();
    const ImVec2 corner(placement.from.x + 10, placement.to.y - line - ramp_size.y - 16);
    const ImVec2 back = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos(corner);
    widgets.canvas("legend", {ramp_size.x + 12, line + ramp_size.y + 10}, fmt::format("{} to {}", ends.black, ends.white));
    ImGui::SetCursorScreenPos(back);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 from(corner.x + 6, corner.y + 5), to(from.x + ramp_size.x, from.y + ramp_size.y);
    list.AddRectFilled(corner, {to.x + 6, to.y + line + 5}, IM_COL32(20, 22, 27, 225), 4);
    draw_ramp(from, to, look);
    list.AddText({from.x, to.y + 2}, packed(palette().text), ends.black.c_str());
    list.AddText({to.x - ImGui::CalcTextSize(ends.white.c_str()).x, to.y + 2}, packed(palette().text), ends.white.c_str());
}

}  // namespace strata::ui
