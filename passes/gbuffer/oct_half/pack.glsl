// Packs a surface as layout C of docs/algorithms/deferred.md 2.1: octahedral coordinates as half floats.
#include "passes/gbuffer/half_depth.glsl"
#include "passes/gbuffer/octahedron.glsl"
#include "passes/gbuffer/packed_words.glsl"

GBufferWords pack_oct_half(MaterialPoint m) {
    GBufferWords words;
    words.g0 = vec4(nearest_half(to_octahedron(m.normal)), pack_half_depth(m.position.z),
                    pack_material(m.occlusion, m.metallic, m.lighting_model));
    words.g1 = pack_color(m.base_color, m.roughness);
    words.g2 = vec4(0.0);
    return words;
}
