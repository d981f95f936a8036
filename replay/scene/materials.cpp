// Materials and textures as records: texels of every texture in one buffer of uints, mips finest first.
#include <cstring>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame/texture.h"
#include "passes/scene/material_uses.h"
#include "passes/shaders/textures.shared.h"
#include "replay/scene/scene_records.h"

namespace strata {
namespace {

TextureUseRecord record(const TextureUse& use) {
    const auto& m = use.transform;
    return {.texture = use.texture, .uv_set = use.uv_set, .row0 = {m[0], m[1], m[2]}, .row1 = {m[3], m[4], m[5]}};
}

uint sampling(const Texture& t) {
    return static_cast<uint>(address_u(t.address)) | static_cast<uint>(address_v(t.address)) << 2 |
           filter_bits(t) << filter_shift;
}

MaterialRecord record(const Material& m) {
    return {
        .base_color = m.base_color,
        .emissive = m.emissive,
        .metallic = m.metallic,
        .transmission = m.transmission,
        .roughness = m.roughness,
        .lighting_model = static_cast<uint>(m.lighting_model),
        .alpha_mode = static_cast<uint>(m.alpha_mode),
        .mask_cutoff = m.mask_cutoff,
        .normal_scale = m.normal_scale,
        .occlusion_strength = m.occlusion_strength,
        .distortion = m.distortion,
        .double_sided = m.double_sided ? 1u : 0u,
        .textures = {record(m.base_color_texture), record(m.metallic_roughness_texture), record(m.normal_texture),
                     record(m.emissive_texture), record(m.occlusion_texture)},  // by kind
    };
}

}  // namespace

void add_materials(const Frame& frame, SceneRecords& scene) {
    for (const Material& m : frame.materials) scene.materials.push_back(record(m));
    for (const Emitter& emitter : frame.emitters) {
        Material sprite{.name = emitter.name, .lighting_model = LightingModel::unlit, .alpha_mode = emitter.alpha_mode};
        sprite.double_sided = true;
        sprite.base_color_texture.texture = emitter.texture;
        scene.materials.push_back(record(sprite));
    }
}

void add_textures(const Frame& frame, SceneRecords& scene) {
    for (const Texture& t : frame.textures) {
        const std::size_t first = scene.texels.size();
        scene.textures.push_back({
            .first = static_cast<uint>(first),
            .format = static_cast<uint>(t.format),
            .width = t.width,
            .height = t.height,
            .mips = t.mips,
            .sampling = sampling(t),
        });
        scene.texels.resize(first + t.texels.size() / 4);
        std::memcpy(scene.texels.data() + first, t.texels.data(), t.texels.size());
    }
}

}  // namespace strata
