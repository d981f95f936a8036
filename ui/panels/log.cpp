// The log: what the replay said, newest at the bottom.
#include "ui/panel.h"
#include "ui/theme.h"

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
            ImGui::TextDisabled("%7.2f s", line.seconds);
            ImGui::SameLine();
            ImGui::PushTextWrapPos(0);
            widgets.text(fmt::format("{}", i), line.text, &color_of(line.kind));
            ImGui::PopTextWrapPos();
        }
        if (services.log.size() > seen_) ImGui::SetScrollHereY(1);
        seen_ = services.log.size();
    }

private:
    std::size_t seen_ = 0;
};

}  // namespace

std::unique_ptr<Panel> log_panel() { return std::make_unique<LogPanel>(); }

}  // namespace strata::ui
