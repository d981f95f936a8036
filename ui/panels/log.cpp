// The log: what the replay said, newest at the bottom.
#include <algorithm>

#include "ui/panel.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

const ImVec4& color_of(LogLine::Kind kind) {
    switch (kind) {
        case LogLine::Kind::warned:
            return palette().warning;
        case LogLine::Kind::failed:
            return palette().bad;
        default:
            return palette().text;
    }
}

class LogPanel final : public Panel {
public:
    void draw(Model&, Services& services) override {
        Widgets& widgets = services.widgets;
        const auto scope = widgets.in("Log");
        for (std::size_t i = 0; i < services.log.size(); ++i) {
            const LogLine& line = services.log[i];
            draw_time(fmt::format("{:.2f} s", line.seconds));
            ImGui::PushTextWrapPos(0);
            widgets.text(fmt::format("{}", i), line.text, &color_of(line.kind));
            ImGui::PopTextWrapPos();
        }
        if (services.log.size() > seen_) ImGui::SetScrollHereY(1);
        seen_ = services.log.size();
    }

private:
    /// Times end where others do.
    static void draw_time(const std::string& time) {
        const float left = ImGui::GetCursorPosX(), wide = ImGui::CalcTextSize("10000.00 s").x;
        ImGui::SetCursorPosX(left + std::max(0.0f, wide - ImGui::CalcTextSize(time.c_str()).x));
        ImGui::TextDisabled("%s", time.c_str());
        ImGui::SameLine(left + wide + ImGui::GetStyle().ItemSpacing.x);
    }

    std::size_t seen_ = 0;
};

}  // namespace

std::unique_ptr<Panel> log_panel() { return std::make_unique<LogPanel>(); }

}  // namespace strata::ui
