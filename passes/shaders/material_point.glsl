// A point of a surface with its material evaluated, in view space: what lights are reflected by. Any shader stage.
#ifndef PASSES_SHADERS_MATERIAL_POINT_GLSL
#define PASSES_SHADERS_MATERIAL_POINT_GLSL
#include "passes/shaders/scene.shared.h"

struct MaterialPoint {
    vec3 position;      // view space, meters
    vec3 normal;        // unit, normal mapped, on the eye's side of the triangle; of hair: along the fiber, towards its tip
    vec3 base_color;    // linear; vertex color and texture are in it
    float alpha;        // base color, vertex color and texture
    float metallic;
    float roughness;    // as the artist says: alpha of the lobe is its square
    float occlusion;
    vec3 emissive;      // radiance
    vec3 transmission;  // k of t = 1 - alpha (1 - k)
    uint lighting_model;
    uint alpha_mode;
};

// Whether `metallic` means anything to a lighting model; elsewhere it is 0.
bool has_metals(uint lighting_model) {
    return lighting_model == model_burley || lighting_model == model_ggx || lighting_model == model_plain_burley ||
           lighting_model == model_multiscatter_ggx;
}

// The normal, for whoever needs one whatever the lighting model. Of hair it is the one of the fiber that faces the eye, or towards
// the eye where a fiber is seen end-on.
vec3 facing_normal(uint lighting_model, vec3 normal, vec3 position) {
    if (lighting_model != model_hair) return normal;
    const vec3 to_eye = normalize(-position);
    const vec3 aside = to_eye - normal * dot(normal, to_eye);
    return dot(aside, aside) > 1e-8 ? normalize(aside) : to_eye;
}

#endif
