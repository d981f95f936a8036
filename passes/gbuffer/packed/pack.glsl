// Packs a surface as layout B of docs/algorithms/deferred.md 2.1 (Lobanchikov and Gruen, S.T.A.L.K.E.R.: Clear Sky, 2009).
#include "passes/gbuffer/half_depth.glsl"
#include "passes/gbuffer/packed_words.glsl"

vec2 pack_packed_normal(vec3 n) {
    const vec2 q = 0.5 * n.xy + 0.5;
    const float x = nearest_half(q.x);
    return vec2(n.z < 0.0 ? -x : x, nearest_half(q.y));
}

GBufferWords pack_packed(MaterialPoint m) {
    return coded_words(pack_packed_normal(m.normal), pack_half_depth(m.position.z), m);
}
