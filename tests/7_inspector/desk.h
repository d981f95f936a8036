// An inspector without a window over every scenario, small, and the hands that use it.
#pragma once

#include <string_view>

#include "ui/script/script.h"

namespace strata::ui {

/// The one of this program: a device and its pipelines are made once. Every call brings it back to frame 0 as recorded, with its
/// views as they are at first, the first tab of every region in front.
class Desk {
public:
    static Desk& clean();

    Context context;
    std::unique_ptr<ImguiLayer> layer;
    std::unique_ptr<Inspector> inspector;
    std::unique_ptr<Player> player;

    Model& model() { return inspector->model(); }
    std::shared_ptr<const Replay> replay() { return inspector->replayer().shown("A"); }
    /// What a widget says; fails the test where there is none.
    std::string said(std::string_view path);
    const WidgetRecord& widget(std::string_view path);
    /// Fails the test for widgets of one name and for messages of the validation layer.
    void expect_no_conflicts();

private:
    Desk();
    void bring_first_tabs_to_the_front();
};

/// The frame of a scenario in the desk's capture.
std::size_t frame_of(std::string_view scenario);
/// The same frames for another session.
std::vector<Frame> small_scenarios();

}  // namespace strata::ui
