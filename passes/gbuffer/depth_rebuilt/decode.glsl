// Decodes layout E of docs/algorithms/deferred.md 2.1: octahedral coordinates in 16 bits each; view depth is the depth buffer's,
// so the position is the sample's wherever attributes were shaded.
#include "passes/gbuffer/bytes.glsl"
#include "passes/gbuffer/coded_surface.glsl"
#include "passes/gbuffer/depth_rebuilt/depth_rebuilt.shared.h"
#include "passes/gbuffer/octahedron.glsl"

Surface decode_depth_rebuilt(GBufferTexel t) {
    // SwiftShader gives surfaces at the end of a floor of 2.5 km a depth of 0, which is infinitely far.
    if (t.g2.r == 0.0 || t.depth == 0.0) return no_surface();
    const uint word = unpack_bytes(t.g0);
    const vec2 p = (vec2(word & 0xffffu, word >> 16) - depth_rebuilt_steps) / depth_rebuilt_steps;
    return coded_surface(from_octahedron(p), view_z(t.depth), t.g2.r, t.g1, t.sample_offset);
}
