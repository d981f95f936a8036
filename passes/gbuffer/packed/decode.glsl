// Decodes layout B of docs/algorithms/deferred.md 2.1: n.xy halves with the sign of z in q.x's sign, half-float view z, material
// code.
#include "passes/gbuffer/codes.glsl"

// The sign bit and not q.x < 0: a -0 decodes as it was meant. Rounding may leave |n.xy| above 1 by 2^-10: z is then 0.
vec3 packed_normal(vec2 q) {
    const vec2 xy = 2.0 * abs(q) - 1.0;
    const float z = sqrt(max(0.0, 1.0 - dot(xy, xy)));
    return normalize(vec3(xy, (floatBitsToUint(q.x) >> 31) != 0u ? -z : z));
}

// A cleared texel would decode to a normal of (-1, -1, 1): the background is masked first.
Surface decode_packed(GBufferTexel t) {
    if (t.g0.a == 0.0) return no_surface();
    const PackedMaterial material = unpack_material(t.g0.a);
    const vec4 color = unpack_color(t.g1);
    return Surface(true, packed_normal(t.g0.xy), t.g0.z, color.rgb, color.a, material.metallic, material.occlusion,
                   material.lighting_model, t.shaded_offset);
}
