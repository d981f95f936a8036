#include "ui/pixel/pixel_part.h"

#include <algorithm>
#include <cmath>

#include "ui/window/theme.h"

namespace strata::ui {
namespace {

/// IEC 61966-2-1.
float display_byte(double light) {
    const double v = std::clamp(light, 0.0, 1.0);  // NaN stays and is drawn black
    return static_cast<float>(v <= .0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - .055);
}

}  // namespace

StatePress draw_state(Widgets& widgets, const Progress* progress, const std::string& error) {
    if (progress) {
        const std::string doing = progress->doing().empty() ? "waiting for the device" : progress->doing();
        const bool stop = widgets.button("stop", "Stop");
        ImGui::SameLine();
        ImGui::ProgressBar(static_cast<float>(progress->fraction()), {-1, 0}, "");
        widgets.text("doing", doing, &palette().dim);
        return stop ? StatePress::stop : StatePress::none;
    }
    if (error.empty()) return StatePress::none;
    ImGui::PushTextWrapPos(0);
    widgets.text("error", error, &palette().warning);
    ImGui::PopTextWrapPos();
    return widgets.button("again", "Again") ? StatePress::again : StatePress::none;
}

void draw_swatch(glm::dvec3 light) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float edge = ImGui::GetTextLineHeight() - 3;
    const ImVec4 color(display_byte(light.x), display_byte(light.y), display_byte(light.z), 1);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({at.x, at.y + 2}, {at.x + edge, at.y + 2 + edge}, packed(color), 2);
    list.AddRect({at.x, at.y + 2}, {at.x + edge, at.y + 2 + edge}, packed(palette().dim, .5f), 2);
    ImGui::Dummy({edge, edge});
    ImGui::SameLine();
}

Request with_display_alone(const Request& request) {
    Request same = request;
    same.outputs = Request().outputs;
    return same;
}

}  // namespace strata::ui
