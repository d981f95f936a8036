// Decodes layout C of docs/algorithms/deferred.md 2.1: octahedral coordinates as half floats, half-float view z, material code.
#include "passes/gbuffer/coded_surface.glsl"
#include "passes/gbuffer/octahedron.glsl"

Surface decode_oct_half(GBufferTexel t) {
    if (t.g0.a == 0.0) return no_surface();
    return coded_surface(from_octahedron(t.g0.xy), t.g0.z, t.g0.a, t.g1, t.shaded_offset);
}
