#include "passes/texture_uses.h"

#include "passes/reference/fragments.h"

namespace strata {
namespace {

void add(const Frame& frame, std::uint32_t texture, std::uint32_t kind, TextureUses& uses) {
    if (texture == no_index) return;
    uses.kinds |= kind;
    uses.formats |= 1u << static_cast<std::uint32_t>(frame.textures[texture].format);
}

}  // namespace

TextureUses texture_uses(const Frame& frame, Surfaces surfaces) {
    TextureUses uses;
    for (const std::uint32_t index : surfaces == Surfaces::opaque ? opaque_draws(frame) : transparent_draws(frame)) {
        if (index >= frame.draws.size()) {
            add(frame, frame.emitters[index - frame.draws.size()].texture, 1, uses);
            continue;
        }
        const Material& material = frame.materials[frame.draws[index].material];
        add(frame, material.base_color_texture.texture, 1, uses);
        add(frame, material.metallic_roughness_texture.texture, 2, uses);
        add(frame, material.normal_texture.texture, 4, uses);
        add(frame, material.emissive_texture.texture, 8, uses);
        add(frame, material.occlusion_texture.texture, 16, uses);
    }
    return uses;
}

DrawPass& fix_textures(DrawPass& pass, const FrameImages& images, Surfaces surfaces) {
    const TextureUses uses = texture_uses(*images.recorded, surfaces);
    return pass.fixes("texture_kinds", uses.kinds).fixes("texture_formats", uses.formats);
}

}  // namespace strata
