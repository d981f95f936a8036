// The pinned pixel through the frame: what every step left of it, its transparent fragments, what techniques make of them, what
// techniques know of its tile.
#include <algorithm>
#include <array>

#include "ui/panel.h"
#include "ui/pixel/pixel_part.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

struct PartRow {
    const char* name;
    std::string_view help;
    std::unique_ptr<PixelPart> (*make)();
};
constexpr PartRow part_rows[] = {
    {"Steps", "the pixel after every step that writes it", pixel_steps_part},
    {"Fragments", "its transparent fragments in the order of depth", pixel_fragments_part},
    {"Probe", "transmittance over depth: any set of techniques over the exact steps", pixel_probe_part},
    {"Tile", "views of a technique at the pixel, and what its tables say of its tile", pixel_inside_part},
};

class PixelPanel final : public Panel {
public:
    PixelPanel() {
        for (std::size_t i = 0; i < parts_.size(); ++i) parts_[i] = part_rows[i].make();
    }

    void draw(Model& model, Services& services) override {
        Widgets& widgets = services.widgets;
        const auto scope = widgets.in("Pixel");
        const auto replay = services.replayer.shown("A");
        if (replay && model.is_known() && model.pin) draw_head(model, widgets, *replay);
        if (replay && model.is_known() && model.pin) return draw_parts(model, services, *replay);
        withdraw_but(parts_.size());
        ImGui::PushTextWrapPos(0);
        widgets.text("state",
                     replay ? "A click on a picture pins a pixel. What happened to it is shown here." : "nothing replayed yet",
                     &palette().dim);
        ImGui::PopTextWrapPos();
    }

    bool is_busy() const override {
        return std::ranges::any_of(parts_, [](const auto& part) { return part->is_busy(); });
    }

private:
    static void draw_head(Model& model, Widgets& widgets, const Replay& replay) {
        const glm::ivec2 pin = *model.pin;
        widgets.text("pixel", fmt::format("\xe2\x8a\x95 {} {}", pin.x, pin.y), &palette().accent);
        widgets.help("column and row of the pixel from the left top; the arrow keys move it");
        ImGui::SameLine();
        widgets.text("frame", fmt::format("of {} x {}", replay.run.width, replay.run.height), &palette().dim);
        ImGui::SameLine();
        if (widgets.button("unpin", "Unpin")) model.pin.reset();
    }

    void draw_parts(Model& model, Services& services, const Replay& replay) {
        std::size_t shown = parts_.size();
        if (ImGui::BeginTabBar("parts")) {
            for (std::size_t i = 0; i < parts_.size(); ++i) {
                const bool selected = ImGui::BeginTabItem(part_rows[i].name);
                {
                    const auto scope = services.widgets.in("parts");
                    services.widgets.tab(part_rows[i].name, selected);
                }
                services.widgets.help(part_rows[i].help);
                if (!selected) continue;
                shown = i;
                parts_[i]->draw(model, services, replay);
                ImGui::EndTabItem();
            }
            ImGui::EndTabBar();
        }
        withdraw_but(shown);
    }

    /// What is not in front computes nothing.
    void withdraw_but(std::size_t shown) {
        for (std::size_t i = 0; i < parts_.size(); ++i)
            if (i != shown) parts_[i]->withdraw();
    }

    std::array<std::unique_ptr<PixelPart>, std::size(part_rows)> parts_;
};

}  // namespace

std::unique_ptr<Panel> pixel_panel() { return std::make_unique<PixelPanel>(); }

}  // namespace strata::ui
