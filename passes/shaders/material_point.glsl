// A point of a surface with its material evaluated, in view space: what lights are reflected by. Any shader stage.
#ifndef PASSES_SHADERS_MATERIAL_POINT_GLSL
#define PASSES_SHADERS_MATERIAL_POINT_GLSL

struct MaterialPoint {
    vec3 position;      // view space, metres
    vec3 normal;        // unit, normal mapped, on the eye's side of the triangle
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

#endif
