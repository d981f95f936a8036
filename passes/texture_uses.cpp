#include "passes/texture_uses.h"

namespace strata {
namespace {

void add(const Frame& frame, std::uint32_t texture, std::uint32_t kind, TextureUses& uses) {
    if (texture == no_index) return;
    uses.kinds |= kind;
    uses.formats |= 1u << static_cast<std::uint32_t>(frame.textures[texture].format);
}

Surfaces surfaces_of(const Material& material) {
    const bool opaque = material.alpha_mode == AlphaMode::opaque || material.alpha_mode == AlphaMode::mask;
    return opaque ? Surfaces::opaque : Surfaces::transparent;
}

}  // namespace

TextureUses texture_uses(const Frame& frame, Surfaces surfaces) {
    TextureUses uses;
    for (const Draw& draw : frame.draws) {
        const Material& material = frame.materials[draw.material];
        if (surfaces_of(material) != surfaces) continue;
        add(frame, material.base_color_texture.texture, 1, uses);
        add(frame, material.metallic_roughness_texture.texture, 2, uses);
        add(frame, material.normal_texture.texture, 4, uses);
        add(frame, material.emissive_texture.texture, 8, uses);
        add(frame, material.occlusion_texture.texture, 16, uses);
    }
    if (surfaces == Surfaces::transparent)
        for (const Emitter& emitter : frame.emitters) add(frame, emitter.texture, 1, uses);
    return uses;
}

DrawPass& fix_textures(DrawPass& pass, const FrameImages& images, Surfaces surfaces) {
    const TextureUses uses = texture_uses(*images.recorded, surfaces);
    return pass.fixes("texture_kinds", uses.kinds).fixes("texture_formats", uses.formats);
}

}  // namespace strata
