// The surface of layouts that keep a material as a code and base color with roughness in 8 bits each.
#ifndef PASSES_GBUFFER_CODED_SURFACE_GLSL
#define PASSES_GBUFFER_CODED_SURFACE_GLSL
#include "passes/gbuffer/codes.glsl"
#include "passes/gbuffer/surface.glsl"

// material: of pack_material(); color: of pack_color(); offset: from the pixel's center to where z is, in pixels.
Surface coded_surface(vec3 normal, float z, float material, vec4 color, vec2 offset) {
    const PackedMaterial m = unpack_material(material);
    const vec4 c = unpack_color(color);
    return Surface(true, normal, z, c.rgb, c.a, m.metallic, m.occlusion, m.lighting_model, offset);
}

#endif
