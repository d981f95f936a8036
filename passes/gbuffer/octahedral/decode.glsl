// Decodes layout D of docs/algorithms/deferred.md 2.1: octahedral normal codes, log-depth code, material code.
#include "passes/gbuffer/coded_surface.glsl"
#include "passes/gbuffer/octahedral/octahedral.shared.h"
#include "passes/gbuffer/octahedron.glsl"

vec3 octahedral_normal(uvec2 codes) { return from_octahedron((vec2(codes) - octahedral_center) / octahedral_center); }

float octahedral_depth(uint code) {
    return view.near * exp2(float(code) / octahedral_depth_steps * log2(octahedral_far_over_near));
}

Surface decode_octahedral(GBufferTexel t) {
    if (t.g0.a == 0.0) return no_surface();
    const vec3 normal = octahedral_normal(uvec2(code_of_half(t.g0.x), code_of_half(t.g0.y)));
    return coded_surface(normal, octahedral_depth(code_of_half(t.g0.z)), t.g0.a, t.g1, t.shaded_offset);
}
