#include "passes/scene/material_uses.h"

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame/texture.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/scene/scene_facts.h"
#include "passes/shaders/scene/materials.shared.h"
#include "passes/shaders/textures.shared.h"
#include "passes/shaders/uses.shared.h"

namespace strata {
namespace {

std::uint32_t bit(auto value) { return 1u << static_cast<std::uint32_t>(value); }

void add(const Frame& frame, std::uint32_t texture, std::uint32_t kind, MaterialUses& uses) {
    if (texture == no_index) return;
    uses.textures |= 1u << kind;
    uses.formats |= bit(frame.textures[texture].format);
    uses.addresses |= bit(address_u(frame.textures[texture].address)) | bit(address_v(frame.textures[texture].address));
    uses.filters |= filter_bits(frame.textures[texture]);
}

/// A picture is clamped and filtered linearly, whatever its texture says (passes/shaders/projected_texture.glsl).
void add_picture(const Frame& frame, const Light& light, MaterialUses& uses) {
    if (light.texture == no_index) return;
    uses.formats |= bit(frame.textures[light.texture].format);
    uses.addresses |= bit(AddressMode::clamp);
}

void add(const Frame& frame, const Material& material, MaterialUses& uses) {
    uses.models |= bit(material.lighting_model);
    uses.alpha_modes |= bit(material.alpha_mode);
    // A texture counts though its factor be 0: float texels may be infinite, and nothing times that is no number.
    if (material.metallic != 0 || material.metallic_roughness_texture.texture != no_index) uses.properties |= property_metallic;
    if (material.emissive != glm::vec3(0) || material.emissive_texture.texture != no_index) uses.properties |= property_emissive;
    if (material.transmission != glm::vec3(0)) uses.properties |= property_transmission;
    if (material.distortion != 0) uses.bends = true;
    uses.properties |= material.double_sided ? property_both_sides : property_one_side;
    add(frame, material.base_color_texture.texture, base_color_texture, uses);
    add(frame, material.metallic_roughness_texture.texture, metallic_roughness_texture, uses);
    add(frame, material.normal_texture.texture, normal_texture, uses);
    add(frame, material.emissive_texture.texture, emissive_texture, uses);
    add(frame, material.occlusion_texture.texture, occlusion_texture, uses);
}

void add(const Mesh& mesh, MaterialUses& uses) {
    uses.drawn |= meshes_drawn;
    if (!mesh.normals.empty()) uses.attributes |= attribute_normal;
    if (!mesh.tangents.empty()) uses.attributes |= attribute_tangent;
    if (!mesh.uv0.empty()) uses.attributes |= attribute_uv0;
    if (!mesh.uv1.empty()) uses.attributes |= attribute_uv1;
    if (!mesh.colors.empty()) uses.attributes |= attribute_color;
}

/// A sprite is unlit and has no back (replay/scene/materials.cpp).
void add(const Frame& frame, const Emitter& emitter, MaterialUses& uses) {
    uses.drawn |= particles_drawn;
    uses.models |= bit(LightingModel::unlit);
    uses.alpha_modes |= bit(emitter.alpha_mode);
    uses.properties |= property_both_sides;
    add(frame, emitter.texture, base_color_texture, uses);
}

/// Attributes that nothing asks for. What is opaque is written with its normal.
std::uint32_t unread(const MaterialUses& uses, Surfaces surfaces) {
    std::uint32_t attributes = 0;
    if (surfaces == Surfaces::transparent && !uses.is_lit() && !uses.bends) attributes |= attribute_normal;
    const bool reads_tangents = (uses.textures & 1u << normal_texture) != 0 || (uses.models & bit(LightingModel::hair)) != 0;
    if (!reads_tangents) attributes |= attribute_tangent;
    if (uses.textures == 0) attributes |= attribute_uv0 | attribute_uv1;
    return attributes;
}

}  // namespace

std::uint32_t filter_bits(const Texture& texture) {
    const std::uint32_t sampling = (texture.magnify == TexelFilter::nearest ? magnifies_nearest : 0u) |
                                   (texture.minify == TexelFilter::nearest ? minifies_nearest : 0u) |
                                   static_cast<std::uint32_t>(texture.between_mips) << mip_shift;
    return sampling >> filter_shift;
}

MaterialUses material_uses(const Frame& frame, const DrawLists& lists, Surfaces surfaces) {
    MaterialUses uses;
    for (const std::uint32_t index : surfaces == Surfaces::opaque ? lists.opaque : lists.transparent) {
        if (index >= frame.draws.size()) {
            add(frame, frame.emitters[index - frame.draws.size()], uses);
            continue;
        }
        add(frame, frame.materials[frame.draws[index].material], uses);
        add(frame.meshes[frame.draws[index].mesh], uses);
    }
    uses.attributes &= ~unread(uses, surfaces);
    // What is transparent is lit where it is drawn, by lights that may have pictures.
    if (surfaces == Surfaces::transparent)
        for (const Light& light : frame.lights) add_picture(frame, light, uses);
    return uses;
}

DrawStep& fix_materials(DrawStep& builder, const FrameImages& images, Surfaces surfaces) {
    const MaterialUses uses = images.facts->material_uses(surfaces);
    return builder.fixes("used_textures", uses.textures)
        .fixes("used_formats", uses.formats)
        .fixes("used_addresses", uses.addresses)
        .fixes("used_filters", uses.filters)
        .fixes("used_models", uses.models)
        .fixes("used_alpha_modes", uses.alpha_modes)
        .fixes("used_properties", uses.properties)
        .fixes("used_attributes", uses.attributes)
        .fixes("drawn", uses.drawn);
}

DrawStep& fix_positions(DrawStep& builder, const FrameImages& images, Surfaces surfaces) {
    return builder.fixes("used_attributes", 0u).fixes("drawn", images.facts->material_uses(surfaces).drawn);
}

}  // namespace strata
