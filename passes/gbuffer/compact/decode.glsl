// Decodes layout F of docs/algorithms/deferred.md 2.1: the bits of A2B10G10R10 in four bytes; view depth is the depth buffer's, so
// the position is the sample's wherever attributes were shaded.
#include "passes/gbuffer/bytes.glsl"
#include "passes/gbuffer/codes.glsl"
#include "passes/gbuffer/compact/compact.shared.h"
#include "passes/gbuffer/octahedron.glsl"

uint compact_model(uint material) {
    if (material == compact_unlit) return model_unlit;
    return material == compact_hair ? model_hair : model_ggx;
}

// All bits of a cleared texel are those of a surface, too: the depth buffer tells.
Surface decode_compact(GBufferTexel t) {
    if (t.depth == 0.0) return no_surface();
    const uint word = unpack_bytes(t.g0);
    const vec2 p = (vec2(word & 1023u, word >> 10 & 1023u) - compact_normal_steps) / compact_normal_steps;
    const uint material = word >> 30;
    const vec4 color = unpack_color(t.g1);
    return Surface(true, from_octahedron(p), view_z(t.depth), color.rgb, color.a, material == compact_metal ? 1.0 : 0.0,
                   float(word >> 20 & 1023u) / compact_occlusion_steps, compact_model(material), t.sample_offset);
}
