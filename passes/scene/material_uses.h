// What of passes/shaders/material.glsl and vertex.glsl a frame calls for: what its meshes, materials and textures really have.
// The rest is compiled away; a CPU driver executes every branch of a shader, taken or not, and reads buffers lane by lane.
#pragma once

#include "capture_format/frame/material.h"
#include "passes/scene/draw_lists.h"

namespace strata {

struct Texture;      // capture_format/frame/texture.h
class DrawStep;      // passes/graph/graph.h
struct FrameImages;  // passes/frame_images.h

enum class Surfaces { opaque, transparent };

/// Bits: textures 1 << a kind of scene.shared.h, formats 1 << TextureFormat, addresses 1 << AddressMode of one direction, filters
/// filter_bits(), models 1 << LightingModel, alpha_modes 1 << AlphaMode; properties, attributes and drawn as uses.shared.h has
/// them.
struct MaterialUses {
    std::uint32_t textures = 0, formats = 0, addresses = 0, filters = 0;
    std::uint32_t models = 0, alpha_modes = 0, properties = 0;
    std::uint32_t attributes = 0, drawn = 0;
    bool bends = false;  ///< a material distorts what is behind it, by its normal

    bool is_lit() const { return (models & ~(1u << static_cast<std::uint32_t>(LightingModel::unlit))) != 0; }
};

/// The filters of a texture as TextureRecord::sampling has them, above filter_shift.
std::uint32_t filter_bits(const Texture&);

MaterialUses material_uses(const Frame&, const DrawLists&, Surfaces);

/// Fixes the constants of material.glsl and vertex.glsl in a step whose shaders include both.
DrawStep& fix_materials(DrawStep&, const FrameImages&, Surfaces);

/// Fixes the constants of vertex.glsl in a step whose fragment shader asks for nothing but where a surface is.
DrawStep& fix_positions(DrawStep&, const FrameImages&, Surfaces);

}  // namespace strata
