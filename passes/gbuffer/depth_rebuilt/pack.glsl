// Packs a surface as layout E of docs/algorithms/deferred.md 2.1: octahedral coordinates in 16 bits each, and no depth of its own.
#include "passes/gbuffer/bytes.glsl"
#include "passes/gbuffer/codes.glsl"
#include "passes/gbuffer/depth_rebuilt/depth_rebuilt.shared.h"
#include "passes/gbuffer/octahedron.glsl"
#include "passes/gbuffer/packed_words.glsl"

vec4 pack_depth_rebuilt_normal(vec3 n) {
    const uvec2 steps = uvec2(floor(clamp(to_octahedron(n), -1.0, 1.0) * depth_rebuilt_steps + 0.5) + depth_rebuilt_steps);
    return pack_bytes(steps.x | steps.y << 16);
}

GBufferWords pack_depth_rebuilt(MaterialPoint m) {
    GBufferWords words;
    words.g0 = pack_depth_rebuilt_normal(m.normal);
    words.g1 = pack_color(m.base_color, m.roughness);
    words.g2 = vec4(pack_material(m.occlusion, m.metallic, m.lighting_model), 0.0, 0.0, 0.0);
    return words;
}
