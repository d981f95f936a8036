// Packs a surface as layout F of docs/algorithms/deferred.md 2.1: octahedral coordinates and occlusion in 10 bits each, 2 bits of
// material, and no depth of its own.
#include "passes/gbuffer/bytes.glsl"
#include "passes/gbuffer/codes.glsl"
#include "passes/gbuffer/compact/compact.shared.h"
#include "passes/gbuffer/octahedron.glsl"
#include "passes/gbuffer/packed_words.glsl"

uint compact_class(float metallic, uint lighting_model) {
    if (lighting_model == model_unlit) return compact_unlit;
    if (lighting_model == model_hair) return compact_hair;
    return has_metals(lighting_model) && metallic >= 0.5 ? compact_metal : compact_dielectric;
}

GBufferWords pack_compact(MaterialPoint m) {
    GBufferWords words;
    const uvec2 steps = uvec2(floor(clamp(to_octahedron(m.normal), -1.0, 1.0) * compact_normal_steps + 0.5) + compact_normal_steps);
    const uint occlusion = uint(floor(clamp(m.occlusion, 0.0, 1.0) * compact_occlusion_steps + 0.5));
    words.g0 = pack_bytes(steps.x | steps.y << 10 | occlusion << 20 | compact_class(m.metallic, m.lighting_model) << 30);
    words.g1 = pack_color(m.base_color, m.roughness);
    words.g2 = vec4(0.0);
    return words;
}
