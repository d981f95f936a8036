// Decodes layout D of docs/algorithms/deferred.md 2.1: octahedral normal codes, log-depth code, material code.
#include "passes/gbuffer/codes.glsl"
#include "passes/gbuffer/octahedral/octahedral.shared.h"

// Cigolle et al. 2014; the fold needs a sign that is never 0.
vec3 octahedral_normal(uvec2 codes) {
    vec2 p = (vec2(codes) - octahedral_center) / octahedral_center;
    const float z = 1.0 - abs(p.x) - abs(p.y);
    const float fold = max(-z, 0.0);
    p -= mix(vec2(-fold), vec2(fold), greaterThanEqual(p, vec2(0.0)));
    return normalize(vec3(p, z));
}

float octahedral_depth(uint code) {
    return view.near * exp2(float(code) / octahedral_depth_steps * log2(octahedral_far_over_near));
}

Surface decode_octahedral(vec4 g0, vec4 g1, vec4 g2, vec2 pixel) {
    if (g0.a == 0.0) return no_surface();
    const PackedMaterial material = unpack_material(g0.a);
    const vec4 color = unpack_color(g1);
    const vec3 normal = octahedral_normal(uvec2(code_of_half(g0.x), code_of_half(g0.y)));
    return Surface(true, normal, octahedral_depth(code_of_half(g0.z)), color.rgb, color.a, material.metallic, material.occlusion,
                   material.lighting_model);
}
