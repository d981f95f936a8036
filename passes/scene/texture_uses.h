// What of passes/shaders/material.glsl a frame calls for: the kinds and formats of textures that its materials really use.
// The rest is compiled away; a CPU driver executes every branch of a shader, taken or not.
#pragma once

#include "capture_format/frame.h"
#include "passes/frame_images.h"
#include "passes/scene/draw_lists.h"

namespace strata {

enum class Surfaces { opaque, transparent };

/// Bits: kinds 1 << a kind of scene.shared.h, formats 1 << TextureFormat, addresses 1 << AddressMode of one direction.
struct TextureUses {
    std::uint32_t kinds = 0, formats = 0, addresses = 0;
};

TextureUses texture_uses(const Frame&, const DrawLists&, Surfaces);

/// Fixes the constants of material.glsl in a step whose fragment shader includes it.
DrawPass& fix_textures(DrawPass&, const FrameImages&, Surfaces);

}  // namespace strata
