// Decodes layout C of docs/algorithms/deferred.md 2.1: octahedral coordinates as half floats, half-float view z, material code.
#include "passes/gbuffer/codes.glsl"
#include "passes/gbuffer/octahedron.glsl"

Surface decode_oct_half(GBufferTexel t) {
    if (t.g0.a == 0.0) return no_surface();
    const PackedMaterial material = unpack_material(t.g0.a);
    const vec4 color = unpack_color(t.g1);
    return Surface(true, from_octahedron(t.g0.xy), t.g0.z, color.rgb, color.a, material.metallic, material.occlusion,
                   material.lighting_model, t.shaded_offset);
}
