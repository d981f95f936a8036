// Writes layout C of docs/algorithms/deferred.md 2.1: octahedral coordinates as half floats.
#include "passes/gbuffer/half_depth.glsl"
#include "passes/gbuffer/octahedron.glsl"
#include "passes/gbuffer/targets.glsl"

void encode(MaterialPoint m) {
    gbuffer0 = vec4(nearest_half(to_octahedron(m.normal)), pack_half_depth(m.position.z),
                    pack_material(m.occlusion, m.metallic, m.lighting_model));
    gbuffer1 = pack_color(m.base_color, m.roughness);
}
