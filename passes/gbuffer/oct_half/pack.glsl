// Packs a surface as layout C of docs/algorithms/deferred.md 2.1: octahedral coordinates as half floats.
#include "passes/gbuffer/half_depth.glsl"
#include "passes/gbuffer/octahedron.glsl"
#include "passes/gbuffer/packed_words.glsl"

GBufferWords pack_oct_half(MaterialPoint m) {
    return coded_words(nearest_half(to_octahedron(m.normal)), pack_half_depth(m.position.z), m);
}
