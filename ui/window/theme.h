// The look of the inspector, and the Dear ImGui context that has it.
#pragma once

#include <cstddef>

#include <imgui.h>

namespace strata::ui {

/// Colors with a meaning; everything else is the style's.
struct Palette {
    ImVec4 accent, good, warning, bad, dim, text, line;
};
const Palette& palette();
ImU32 packed(const ImVec4&, float alpha = 1);
/// A color per stage that is easy to tell from its neighbors'.
ImVec4 color_of_stage(std::size_t index);

/// Dear ImGui for one inspector: fonts, style, keys. Nothing is read from or written to the current folder.
class Context {
public:
    Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    ~Context();

private:
    ImGuiContext* context_;
};

}  // namespace strata::ui
