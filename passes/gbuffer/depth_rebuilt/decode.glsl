// Decodes layout E of docs/algorithms/deferred.md 2.1: octahedral coordinates in 16 bits each; view depth is the depth buffer's,
// so the position is the sample's wherever attributes were shaded.
#include "passes/gbuffer/bytes.glsl"
#include "passes/gbuffer/codes.glsl"
#include "passes/gbuffer/depth_rebuilt/depth_rebuilt.shared.h"
#include "passes/gbuffer/octahedron.glsl"

Surface decode_depth_rebuilt(GBufferTexel t) {
    if (t.g2.r == 0.0) return no_surface();
    const uint word = unpack_bytes(t.g0);
    const vec2 p = (vec2(word & 0xffffu, word >> 16) - depth_rebuilt_steps) / depth_rebuilt_steps;
    const PackedMaterial material = unpack_material(t.g2.r);
    const vec4 color = unpack_color(t.g1);
    return Surface(true, from_octahedron(p), view_z(t.depth), color.rgb, color.a, material.metallic, material.occlusion,
                   material.lighting_model, t.sample_offset);
}
