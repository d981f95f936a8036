// How surfaces of a frame reflect and let light through.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include <glm/glm.hpp>

#include "capture_format/frame/glm_types.h"
#include "capture_format/frame/no_index.h"

namespace strata {

/// How a surface reflects. Burley is renormalized, plain_burley as published. Hair's tangents run along its fibers, from root to
/// tip; without tangents fibers stick out along the normals.
enum class LightingModel : std::uint32_t { unlit, lambert, burley, ggx, cloth, skin, hair, plain_burley, multiscatter_ggx };
/// The last lighting model.
inline constexpr LightingModel last_lighting_model = LightingModel::multiscatter_ggx;
/// Whether `metallic` means anything to a lighting model; elsewhere it counts as 0.
inline bool has_metals(LightingModel model) {
    return model == LightingModel::burley || model == LightingModel::ggx || model == LightingModel::plain_burley ||
           model == LightingModel::multiscatter_ggx;
}
enum class AlphaMode : std::uint32_t { opaque, mask, blend, premultiplied, additive };
/// Whether something behind it may be seen through a covered sample.
inline bool is_transparent(AlphaMode mode) { return mode != AlphaMode::opaque && mode != AlphaMode::mask; }

/// A texture with its uv set and affine uv transform: uv' = transform * (u, v, 1), row by row.
struct TextureUse {
    std::uint32_t texture = no_index;
    std::uint32_t uv_set = 0;
    std::array<float, 6> transform = {1, 0, 0, 0, 1, 0};
};

struct Material {
    std::string name;
    LightingModel lighting_model = LightingModel::ggx;
    AlphaMode alpha_mode = AlphaMode::opaque;
    glm::vec4 base_color{1};  ///< linear, unpremultiplied; a is coverage
    float metallic = 0;       ///< of models that have metals
    float roughness = 1;
    glm::vec3 emissive{0};  ///< radiance
    float normal_scale = 1;
    float occlusion_strength = 1;
    float mask_cutoff = 0.5f;
    glm::vec3 transmission{0};  ///< k of t = 1 - alpha (1 - k): the color glass lets through; 0 is gray smoke
    float distortion = 0;       ///< uv offset per unit of view-space normal
    bool double_sided = false;
    TextureUse base_color_texture, metallic_roughness_texture, normal_texture, emissive_texture, occlusion_texture;
};

}  // namespace strata
