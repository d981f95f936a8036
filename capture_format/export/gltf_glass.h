// Colored transmittance in the words of glTF: a share of the light that goes through, tinted, behind a surface that reflects
// some, in a volume that absorbs some.
#pragma once

#include <glm/glm.hpp>

namespace strata::to_gltf_parts {

/// What a material of ours asks for.
struct GlassWanted {
    glm::dvec3 reflected{0};     ///< base color without texture
    glm::dvec3 transmitted{0};   ///< Material::transmission
    glm::dvec3 texture_mean{1};  ///< of the base color texture, which glTF tints what goes through with
};

/// What glTF's extensions say: reflected = color (1 - share), transmitted = color texture_mean share (1 - R(ior)) attenuation.
struct Glass {
    glm::dvec3 color{1};
    double share = 0;
    double ior = 1.5;
    glm::dvec3 attenuation{1};
    bool is_exact = true;  ///< false: no such values exist, these are near
};

/// Prefers the index of refraction of glass; 1 lets everything through.
Glass glass_of(const GlassWanted&);

}  // namespace strata::to_gltf_parts
