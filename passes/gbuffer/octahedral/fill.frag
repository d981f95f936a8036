// Writes layout D of docs/algorithms/deferred.md 2.1 (Cigolle et al., A Survey of Efficient Representations for Independent Unit
// Vectors, 2014).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gbuffer/fill.glsl"
#include "passes/gbuffer/octahedral/octahedral.shared.h"

float octahedral_code(float p) {
    return half_of_code(uint(floor(clamp(p, -1.0, 1.0) * octahedral_center + 0.5) + octahedral_center));
}

vec2 pack_normal(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    if (n.z < 0.0) p = (1.0 - abs(p.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(p, vec2(0.0)));
    return vec2(octahedral_code(p.x), octahedral_code(p.y));
}

// z is extrapolated to the pixel's center and may lie before the near plane, or behind the eye.
float pack_depth(float z) {
    const float share = log2(max(z / view.near, 1.0)) / log2(octahedral_far_over_near);
    return half_of_code(uint(floor(min(share, 1.0) * octahedral_depth_steps + 0.5)));
}

void main() {
    const MaterialPoint m = visible_point();
    gbuffer0 = vec4(pack_normal(m.normal), pack_depth(m.position.z), pack_material(m.occlusion, m.metallic, m.lighting_model));
    gbuffer1 = pack_color(m.base_color, m.roughness);
    emission = emitted(m);
}
