#include "ui/window/input_queue.h"

#include <algorithm>
#include <set>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace strata::ui {

namespace {

bool is_modifier(int key) { return key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER; }

}  // namespace

/// What happened in one already.
struct InputQueue::Frame {
    std::set<int> buttons;
    bool has_key = false, moved = false, wheeled = false;

    /// A key changes together with the modifiers that went down for it. A button changes once, where a frame saw the mouse before
    /// (what lies over others is only then under it); and the mouse stays where a button changed or the wheel turned.
    bool takes(const Event& event) {
        switch (event.kind) {
            case Kind::key:
                return !std::exchange(has_key, has_key || !event.is_down || !is_modifier(event.number));
            case Kind::button:
                return !moved && buttons.insert(event.number).second;
            case Kind::move:
                moved = true;
                return buttons.empty() && !wheeled;
            case Kind::wheel:
                wheeled = true;
                return buttons.empty();
            case Kind::text:
                return buttons.empty();
        }
        return true;
    }
};

void InputQueue::begin_frame(ImGuiIO& io) {
    Frame frame;
    for (; !events_.empty() && frame.takes(events_.front()); events_.pop_front()) apply(events_.front(), io);
    std::ranges::copy(buttons_, io.MouseDown);
    if (mouse_ && ImGui::IsMousePosValid(&io.MousePos)) io.MousePos = *mouse_;
}

void InputQueue::apply(const Event& event, ImGuiIO& io) {
    const auto is_down = [&](int left, int right) { return io.KeysDown[left] || io.KeysDown[right]; };
    switch (event.kind) {
        case Kind::key:
            io.KeysDown[event.number] = event.is_down;
            io.KeyCtrl = is_down(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
            io.KeyShift = is_down(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
            io.KeyAlt = is_down(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT);
            io.KeySuper = is_down(GLFW_KEY_LEFT_SUPER, GLFW_KEY_RIGHT_SUPER);
            break;
        case Kind::button:
            buttons_[event.number] = event.is_down;
            break;
        case Kind::move:
            mouse_ = event.mouse;
            break;
        case Kind::wheel:
            io.MouseWheelH += event.mouse.x;
            io.MouseWheel += event.mouse.y;
            break;
        case Kind::text:
            io.AddInputCharacter(event.character);
            break;
    }
}

}  // namespace strata::ui
