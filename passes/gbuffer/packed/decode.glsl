// Decodes layout B of docs/algorithms/deferred.md 2.1: n.xy halves with the sign of z in q.x's sign, half-float view z, material
// code.
#include "passes/gbuffer/coded_surface.glsl"

// The sign bit and not q.x < 0: a -0 decodes as it was meant. Rounding may leave |n.xy| above 1 by 2^-10: z is then 0.
vec3 packed_normal(vec2 q) {
    const vec2 xy = 2.0 * abs(q) - 1.0;
    const float z = sqrt(max(0.0, 1.0 - dot(xy, xy)));
    return normalize(vec3(xy, (floatBitsToUint(q.x) >> 31) != 0u ? -z : z));
}

// A cleared texel would decode to a normal of (-1, -1, 1): the background is masked first.
Surface decode_packed(GBufferTexel t) {
    if (t.g0.a == 0.0) return no_surface();
    return coded_surface(packed_normal(t.g0.xy), t.g0.z, t.g0.a, t.g1, t.shaded_offset);
}
