// Keys by name, as Dear ImGui is told of them here: the numbers are GLFW's, with a window and without.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <imgui.h>

namespace strata::ui {

struct Chord {
    int key = 0;  ///< in ImGuiIO::KeysDown
    bool ctrl = false, shift = false, alt = false;
};

/// "ctrl+z", "f1", "left", "a"; nothing where there is no such key.
std::optional<Chord> chord_of(std::string_view name);
/// What a key does while it is held down.
enum class WhileHeld { once, repeats };
/// Whether it went down in this frame, or repeats, and nobody types text.
bool is_pressed(const Chord&, WhileHeld);
/// "Ctrl+Z".
std::string for_people(std::string_view chord);
/// Tells Dear ImGui which numbers its own keys have.
void map_keys(ImGuiIO&);

}  // namespace strata::ui
