// What a G-buffer texel means, whichever layout wrote it.
#ifndef PASSES_GBUFFER_SURFACE_GLSL
#define PASSES_GBUFFER_SURFACE_GLSL
#include "passes/shaders/camera.glsl"
#include "passes/shaders/material_point.glsl"

// What a layout's decode.glsl is given.
struct GBufferTexel {
    vec4 g0, g1, g2;
    float depth;         // of the depth buffer, at the sample; bound only for layouts that read it
    vec2 center;         // of the pixel, in pixels
    vec2 shaded_offset;  // from the center to where attributes were shaded, in pixels
    vec2 sample_offset;  // from the center to the sample, where the depth buffer was written
};

struct Surface {
    bool exists;      // false on the background: nothing else is then defined
    vec3 normal;      // view space, unit; of hair: along the fiber, towards its tip
    float z;          // view depth, meters
    vec3 base_color;  // linear
    float roughness;
    float metallic;
    float occlusion;  // of the material
    uint lighting_model;
    vec2 offset;  // from the pixel's center to where z is, in pixels
};

Surface no_surface() { return Surface(false, vec3(0.0), 0.0, vec3(0.0), 0.0, 0.0, 0.0, 0u, vec2(0.0)); }

// Whether lights matter to it: what an unlit surface has is emission.
bool takes_light(Surface s) { return s.exists && s.lighting_model != model_unlit; }

// Depth and position belong to one point: the pixel's center for every sample where attributes are shaded there, the sample where
// they are shaded there or depth is the depth buffer's (docs/algorithms/deferred.md 2.2).
vec3 surface_position(Surface s, uvec2 pixel) { return view_position(vec2(pixel) + 0.5 + s.offset, s.z); }

// What is lit. Emission has an image of its own.
MaterialPoint lit_point(Surface s, uvec2 pixel) {
    return MaterialPoint(surface_position(s, pixel), s.normal, s.base_color, 1.0, s.metallic, s.roughness, s.occlusion, vec3(0.0),
                         vec3(0.0), s.lighting_model, 0u);
}

#endif
