// Colors of texels as the screen shows them, on the host: for legends, and for pictures that are saved.
#pragma once

#include <array>
#include <cstddef>

#include "ui/window/imgui_layer.h"

namespace strata::ui {

/// The bytes that imgui_layer.frag gives a texel at a pixel or more each; where the look multiplies, to one in 255.
std::array<std::byte, 3> shown_bytes(const Look&, const glm::dvec4& texel);
/// The same for draw lists.
ImU32 shown_color(const Look&, const glm::dvec4& texel);

}  // namespace strata::ui
