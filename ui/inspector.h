// The inspector without its window: what it shows in a frame, whoever brings the mouse and takes the picture. A window does, a
// script does, and a test does.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ui/panel.h"
#include "ui/picture/go_to_pixel.h"
#include "ui/save_window.h"
#include "ui/shader_reload.h"
#include "ui/window/frame_rate.h"
#include "ui/window/layout.h"
#include "ui/window/theme.h"

namespace strata::ui {

class Inspector {
public:
    /// Needs a Context, and the layer on which it is drawn. `open` is called on the replay's thread.
    Inspector(ImguiLayer&, Model, Replayer::Open, Layout);
    ~Inspector();

    /// One frame, of which ImGuiIO knows size, time and input.
    void frame();
    /// Draws it: a frame that nobody looks at need not be.
    Result<void> render() { return layer_->draw(*ImGui::GetDrawData()); }
    /// Nothing is being computed that would change what is shown.
    bool is_settled() const;
    /// Somebody asked to close the window.
    bool is_closing() const { return is_closing_; }
    /// Says why something is not done, in the log and for a while in place of the command line. What is open stays.
    void refuse(const Error&);
    /// "smoke.strata, frame 0 - Strata on llvmpipe".
    std::string title() const;

    Model& model() { return model_; }
    const Model& model() const { return model_; }
    Widgets& widgets() { return widgets_; }
    const Widgets& widgets() const { return widgets_; }
    Replayer& replayer() { return *replayer_; }
    const Replayer& replayer() const { return *replayer_; }
    const Layout& layout() const { return layout_; }
    const FrameRate& frame_rate() const { return frame_rate_; }
    const std::vector<LogLine>& log() const { return log_; }

private:
    struct Shown {
        const PanelRow* row;
        std::unique_ptr<Panel> panel;
    };

    Services services();
    void take_results();
    void say_what_was_replayed(const Replay&);
    /// Before any panel asks for a replay beside it, so that it is the picture's replay that executes what was changed.
    void wish_for_the_picture();
    void say_what_was_opened(const CaptureFacts&);
    void press_keys();
    void press_panel_keys();
    void draw();
    void draw_top_bar();
    void draw_frame_choice();
    void draw_activity();
    void draw_regions(ImVec2 size);
    void draw_region(Area, ImVec2 size);
    /// What can be pulled between two regions; `pulled` is how far along the axis it was.
    float splitter(std::string_view name, ImVec2 size, ImGuiMouseCursor);
    void draw_status();
    void draw_keys();
    void save_window();
    void say(LogLine::Kind, std::string);

    ImguiLayer* layer_;
    Model model_;
    Widgets widgets_;
    Layout layout_;
    std::vector<LogLine> log_;
    double seconds_ = 0;
    std::string last_error_;  ///< that the log has
    std::string last_id_;     ///< and its id with the values of its sentence
    std::string refusal_;
    double refusal_ends_ = 0;
    std::shared_ptr<const Replay> last_replay_;
    std::string last_executed_;  ///< of that replay, as the log has it
    std::vector<std::string> last_outputs_;
    bool keys_are_shown_ = false, is_closing_ = false, saves_window_ = false;
    bool was_busy_ = false;  ///< as the frame before left it
    FrameRate frame_rate_;
    SaveWindow save_window_;
    GoToPixel go_to_pixel_;
    std::unique_ptr<Replayer> replayer_;
    std::unique_ptr<WorkQueue> host_;
    ShaderReload shader_reload_;
    std::vector<Shown> panels_;  // last: they hold jobs of the queues
};

}  // namespace strata::ui
