// Decodes layout B' of docs/algorithms/deferred.md 2.1: n.z as it is, n.x with the sign of n.y, half-float view z, material code.
#include "passes/gbuffer/coded_surface.glsl"

// The sign bit and not q.y < 0: a -0 decodes as it was meant.
vec3 z_first_normal(vec2 q) {
    const float x = 2.0 * abs(q.y) - 1.0;
    const float y = sqrt(max(0.0, 1.0 - x * x - q.x * q.x));
    return normalize(vec3(x, (floatBitsToUint(q.y) >> 31) != 0u ? -y : y, q.x));
}

Surface decode_z_first(GBufferTexel t) {
    if (t.g0.a == 0.0) return no_surface();
    return coded_surface(z_first_normal(t.g0.xy), t.g0.z, t.g0.a, t.g1, t.shaded_offset);
}
