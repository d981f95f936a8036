// Materials and their textures on the device.
#ifndef PASSES_SHADERS_SCENE_MATERIALS_SHARED_H
#define PASSES_SHADERS_SCENE_MATERIALS_SHARED_H
#include "passes/shader_interop.h"
#include "passes/shaders/scene/no_index.shared.h"
#ifdef __cplusplus
namespace strata {
#endif

// Lighting models and alpha modes have the values of capture_format/frame.h.
const uint model_unlit = 0u;
const uint model_lambert = 1u;
const uint model_burley = 2u;
const uint model_ggx = 3u;
const uint model_cloth = 4u;
const uint model_skin = 5u;
const uint model_hair = 6u;
const uint model_plain_burley = 7u;
const uint model_multiscatter_ggx = 8u;
const uint alpha_opaque = 0u;
const uint alpha_mask = 1u;
const uint alpha_blend = 2u;
const uint alpha_premultiplied = 3u;
const uint alpha_additive = 4u;

// Kinds of textures that a material has.
const uint base_color_texture = 0u;
const uint metallic_roughness_texture = 1u;
const uint normal_texture = 2u;
const uint emissive_texture = 3u;
const uint occlusion_texture = 4u;
const uint texture_kinds = 5u;

struct TextureUseRecord {
    uint texture;  // no_index: none, white
    uint uv_set;
    vec3 row0;  // u' = dot(row0, (u, v, 1))
    vec3 row1;
};

struct MaterialRecord {
    vec4 base_color;
    vec3 emissive;
    float metallic;
    vec3 transmission;
    float roughness;
    uint lighting_model;
    uint alpha_mode;
    float mask_cutoff;
    float normal_scale;
    float occlusion_strength;
    float distortion;
    uint double_sided;
    TextureUseRecord textures[texture_kinds];  // by kind
};

// Texels lie in one buffer: rgba8 is one uint, rgba16f two, rgba32f four. Mips follow each other, finest first.
struct TextureRecord {
    uint first;   // index of the first uint in texels
    uint format;  // TextureFormat of capture_format/frame.h
    uint width;
    uint height;
    uint mips;
    uint sampling;  // AddressMode along u, and along v two bits higher; filters, as passes/shaders/textures.shared.h has them
};

#ifdef __cplusplus
}
#endif
#endif
