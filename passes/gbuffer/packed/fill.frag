// Writes layout B of docs/algorithms/deferred.md 2.1 (Lobanchikov and Gruen, S.T.A.L.K.E.R.: Clear Sky, 2009).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gbuffer/fill.glsl"

vec2 pack_normal(vec3 n) {
    const vec2 q = 0.5 * n.xy + 0.5;
    const float x = nearest_half(q.x);
    return vec2(n.z < 0.0 ? -x : x, nearest_half(q.y));
}

// z is extrapolated to the pixel's center and may lie before the near plane, or behind the eye; 65504 m is the last half.
float pack_depth(float z) { return nearest_half(clamp(z, view.near, largest_half)); }

void main() {
    const MaterialPoint m = visible_point();
    gbuffer0 = vec4(pack_normal(m.normal), pack_depth(m.position.z), pack_material(m.occlusion, m.metallic, m.lighting_model));
    gbuffer1 = pack_color(m.base_color, m.roughness);
    emission = emitted(m);
}
