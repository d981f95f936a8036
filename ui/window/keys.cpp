#include "ui/window/keys.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace strata::ui {
namespace {

constexpr std::pair<std::string_view, int> named_keys[] = {
    {"left", GLFW_KEY_LEFT},      {"right", GLFW_KEY_RIGHT},         {"up", GLFW_KEY_UP},       {"down", GLFW_KEY_DOWN},
    {"pageup", GLFW_KEY_PAGE_UP}, {"pagedown", GLFW_KEY_PAGE_DOWN},  {"home", GLFW_KEY_HOME},   {"end", GLFW_KEY_END},
    {"enter", GLFW_KEY_ENTER},    {"escape", GLFW_KEY_ESCAPE},       {"space", GLFW_KEY_SPACE}, {"tab", GLFW_KEY_TAB},
    {"delete", GLFW_KEY_DELETE},  {"backspace", GLFW_KEY_BACKSPACE}, {"minus", GLFW_KEY_MINUS}, {"plus", GLFW_KEY_EQUAL},
};

constexpr std::pair<int, int> imgui_keys[] = {
    {ImGuiKey_Tab, GLFW_KEY_TAB},
    {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
    {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
    {ImGuiKey_UpArrow, GLFW_KEY_UP},
    {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
    {ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
    {ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
    {ImGuiKey_Home, GLFW_KEY_HOME},
    {ImGuiKey_End, GLFW_KEY_END},
    {ImGuiKey_Insert, GLFW_KEY_INSERT},
    {ImGuiKey_Delete, GLFW_KEY_DELETE},
    {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
    {ImGuiKey_Space, GLFW_KEY_SPACE},
    {ImGuiKey_Enter, GLFW_KEY_ENTER},
    {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
    {ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER},
    {ImGuiKey_A, GLFW_KEY_A},
    {ImGuiKey_C, GLFW_KEY_C},
    {ImGuiKey_V, GLFW_KEY_V},
    {ImGuiKey_X, GLFW_KEY_X},
    {ImGuiKey_Y, GLFW_KEY_Y},
    {ImGuiKey_Z, GLFW_KEY_Z},
};

std::optional<int> key_of(std::string_view name) {
    const auto named = std::ranges::find(named_keys, name, &std::pair<std::string_view, int>::first);
    if (named != std::end(named_keys)) return named->second;
    if (name.size() == 1 && std::isalnum(static_cast<unsigned char>(name[0])))
        return std::toupper(static_cast<unsigned char>(name[0]));  // GLFW's letters and digits are ASCII's
    if (name.size() >= 2 && name[0] == 'f' && std::isdigit(static_cast<unsigned char>(name[1]))) {
        const int number = std::atoi(std::string(name.substr(1)).c_str());
        if (number >= 1 && number <= 12) return GLFW_KEY_F1 + number - 1;
    }
    return {};
}

}  // namespace

std::optional<Chord> chord_of(std::string_view name) {
    Chord chord;
    for (;;) {
        if (name.starts_with("ctrl+")) chord.ctrl = true;
        else if (name.starts_with("alt+")) chord.alt = true;
        else if (name.starts_with("shift+")) chord.shift = true;
        else break;
        name.remove_prefix(name.find('+') + 1);
    }
    const auto key = key_of(name);
    if (!key) return {};
    chord.key = *key;
    return chord;
}

bool is_pressed(const Chord& chord, WhileHeld held) {
    const ImGuiIO& io = ImGui::GetIO();
    return !io.WantTextInput && io.KeyCtrl == chord.ctrl && io.KeyShift == chord.shift && io.KeyAlt == chord.alt &&
           ImGui::IsKeyPressed(chord.key, held == WhileHeld::repeats);
}

std::string for_people(std::string_view chord) {
    if (chord == "pageup") return "Page Up";
    if (chord == "pagedown") return "Page Down";
    std::string text(chord);
    bool first = true;
    for (char& c : text) {
        if (first) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        first = c == '+';
    }
    return text;
}

void map_keys(ImGuiIO& io) {
    for (const auto& [own, key] : imgui_keys) io.KeyMap[own] = key;
}

}  // namespace strata::ui
