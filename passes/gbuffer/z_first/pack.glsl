// Packs a surface as layout B' of docs/algorithms/deferred.md 2.1: the packing that the X-Ray engine had later.
#include "passes/gbuffer/half_depth.glsl"
#include "passes/gbuffer/packed_words.glsl"

vec2 pack_z_first_normal(vec3 n) {
    const float x = nearest_half(0.5 * n.x + 0.5);
    return vec2(nearest_half(n.z), n.y < 0.0 ? -x : x);
}

GBufferWords pack_z_first(MaterialPoint m) {
    return coded_words(pack_z_first_normal(m.normal), pack_half_depth(m.position.z), m);
}
