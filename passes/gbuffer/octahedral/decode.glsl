// Decodes layout D of docs/algorithms/deferred.md 2.1: octahedral normal codes, log-depth code, material code.
#include "passes/gbuffer/codes.glsl"
#include "passes/gbuffer/octahedral/octahedral.shared.h"
#include "passes/gbuffer/octahedron.glsl"

vec3 octahedral_normal(uvec2 codes) { return from_octahedron((vec2(codes) - octahedral_center) / octahedral_center); }

float octahedral_depth(uint code) {
    return view.near * exp2(float(code) / octahedral_depth_steps * log2(octahedral_far_over_near));
}

Surface decode_octahedral(GBufferTexel t) {
    if (t.g0.a == 0.0) return no_surface();
    const PackedMaterial material = unpack_material(t.g0.a);
    const vec4 color = unpack_color(t.g1);
    const vec3 normal = octahedral_normal(uvec2(code_of_half(t.g0.x), code_of_half(t.g0.y)));
    return Surface(true, normal, octahedral_depth(code_of_half(t.g0.z)), color.rgb, color.a, material.metallic, material.occlusion,
                   material.lighting_model, t.shaded_offset);
}
