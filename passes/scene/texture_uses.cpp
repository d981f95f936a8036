#include "passes/scene/texture_uses.h"

#include "passes/scene/scene_facts.h"
#include "passes/shaders/scene.shared.h"

namespace strata {
namespace {

std::uint32_t bit(auto value) { return 1u << static_cast<std::uint32_t>(value); }

void add(const Frame& frame, std::uint32_t texture, std::uint32_t kind, TextureUses& uses) {
    if (texture == no_index) return;
    uses.kinds |= 1u << kind;
    uses.formats |= bit(frame.textures[texture].format);
    uses.addresses |= bit(address_u(frame.textures[texture].address)) | bit(address_v(frame.textures[texture].address));
}

/// A picture is clamped, whatever its texture says (passes/shaders/projected_texture.glsl).
void add_picture(const Frame& frame, const Light& light, TextureUses& uses) {
    if (light.texture == no_index) return;
    uses.formats |= bit(frame.textures[light.texture].format);
    uses.addresses |= bit(AddressMode::clamp);
}

}  // namespace

TextureUses texture_uses(const Frame& frame, const DrawLists& lists, Surfaces surfaces) {
    TextureUses uses;
    for (const std::uint32_t index : surfaces == Surfaces::opaque ? lists.opaque : lists.transparent) {
        if (index >= frame.draws.size()) {
            add(frame, frame.emitters[index - frame.draws.size()].texture, base_color_texture, uses);
            continue;
        }
        const Material& material = frame.materials[frame.draws[index].material];
        add(frame, material.base_color_texture.texture, base_color_texture, uses);
        add(frame, material.metallic_roughness_texture.texture, metallic_roughness_texture, uses);
        add(frame, material.normal_texture.texture, normal_texture, uses);
        add(frame, material.emissive_texture.texture, emissive_texture, uses);
        add(frame, material.occlusion_texture.texture, occlusion_texture, uses);
    }
    // What is transparent is lit where it is drawn, by lights that may have pictures.
    if (surfaces == Surfaces::transparent)
        for (const Light& light : frame.lights) add_picture(frame, light, uses);
    return uses;
}

DrawPass& fix_textures(DrawPass& pass, const FrameImages& images, Surfaces surfaces) {
    const TextureUses uses = images.facts->texture_uses(surfaces);
    return pass.fixes("used_textures", uses.kinds).fixes("used_formats", uses.formats).fixes("used_addresses", uses.addresses);
}

}  // namespace strata
