// What mouse and keys did, handed on so that nothing is lost where a frame takes long. Dear ImGui 1.86 sees what is down and
// where the mouse is when a frame begins: of a key that was let go by then it would never know, and a click would be where the
// mouse went afterwards.
#pragma once

#include <deque>
#include <optional>

#include <imgui.h>

namespace strata::ui {

class InputQueue {
public:
    /// Numbers are GLFW's.
    void key(int key, bool is_down) { events_.push_back({.kind = Kind::key, .number = key, .is_down = is_down}); }
    void button(int button, bool is_down) { events_.push_back({.kind = Kind::button, .number = button, .is_down = is_down}); }
    void move(ImVec2 to) { events_.push_back({.kind = Kind::move, .mouse = to}); }
    void wheel(ImVec2 steps) { events_.push_back({.kind = Kind::wheel, .mouse = steps}); }
    void text(unsigned character) { events_.push_back({.kind = Kind::text, .character = character}); }

    /// As much of it, in its order, as Dear ImGui can tell apart in one frame.
    void begin_frame(ImGuiIO&);

private:
    enum class Kind { key, button, move, wheel, text };
    struct Event {
        Kind kind;
        int number = 0;
        bool is_down = false;
        ImVec2 mouse = {};
        unsigned character = 0;
    };
    struct Frame;

    void apply(const Event&, ImGuiIO&);

    std::deque<Event> events_;
    bool buttons_[IM_ARRAYSIZE(ImGuiIO::MouseDown)] = {};
    std::optional<ImVec2> mouse_;
};

}  // namespace strata::ui
