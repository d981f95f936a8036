#include "ui/panel.h"

namespace strata::ui {

std::unique_ptr<Panel> frame_panel();
std::unique_ptr<Panel> image_panel();
std::unique_ptr<Panel> compare_panel();
std::unique_ptr<Panel> pixel_panel();
std::unique_ptr<Panel> cost_panel();
std::unique_ptr<Panel> techniques_panel();
std::unique_ptr<Panel> visualizers_panel();
std::unique_ptr<Panel> plan_panel();
std::unique_ptr<Panel> counters_panel();
std::unique_ptr<Panel> capture_panel();
std::unique_ptr<Panel> log_panel();

std::span<const PanelRow> panels() {
    static constexpr PanelRow table[] = {
        {"Frame", Area::left, "stages and steps in order, what they take, and what was left out and why", frame_panel},
        {"Pixel", Area::left, "the pinned pixel: after every step, its fragments, its transmittance, its tile", pixel_panel},
        {"Image", Area::center, "any output of any step, with the values of its texels", image_panel},
        {"Compare", Area::center, "two of: replays, expectation, truth, files; pictures and numbers", compare_panel},
        {"Accuracy and cost", Area::center, "every technique of a stage: its error against its cost; a click applies one",
         cost_panel},
        {"Plan", Area::center, "which step writes and reads what, barriers, who shares memory, what was left out", plan_panel},
        {"Techniques", Area::right, "how each stage is done: technique, settings, forced features", techniques_panel},
        {"Visualizers", Area::right, "debug views and tables of the techniques in use", visualizers_panel},
        {"Counters", Area::bottom, "what techniques counted, beside what they counted before", counters_panel},
        {"Capture", Area::bottom, "what the frame is made of: draws, materials, lights, weather", capture_panel},
        {"Log", Area::bottom, "what the replay said", log_panel},
    };
    return table;
}

}  // namespace strata::ui
