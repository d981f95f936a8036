// Writes layout E of docs/algorithms/deferred.md 2.1: octahedral coordinates in 16 bits each, and no depth of its own.
#include "passes/gbuffer/bytes.glsl"
#include "passes/gbuffer/codes.glsl"
#include "passes/gbuffer/depth_rebuilt/depth_rebuilt.shared.h"
#include "passes/gbuffer/octahedron.glsl"
#include "passes/gbuffer/targets.glsl"

layout(location = 3) out vec4 gbuffer2;

vec4 pack_normal(vec3 n) {
    const uvec2 steps = uvec2(floor(clamp(to_octahedron(n), -1.0, 1.0) * depth_rebuilt_steps + 0.5) + depth_rebuilt_steps);
    return pack_bytes(steps.x | steps.y << 16);
}

void encode(MaterialPoint m) {
    gbuffer0 = pack_normal(m.normal);
    gbuffer1 = pack_color(m.base_color, m.roughness);
    gbuffer2 = vec4(pack_material(m.occlusion, m.metallic, m.lighting_model), 0.0, 0.0, 0.0);
}
