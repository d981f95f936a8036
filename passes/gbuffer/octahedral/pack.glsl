// Packs a surface as layout D of docs/algorithms/deferred.md 2.1 (Cigolle et al., A Survey of Efficient Representations for
// Independent Unit Vectors, 2014).
#include "passes/gbuffer/codes.glsl"
#include "passes/gbuffer/octahedral/octahedral.shared.h"
#include "passes/gbuffer/octahedron.glsl"
#include "passes/gbuffer/packed_words.glsl"
#include "passes/shaders/scene.glsl"

float octahedral_code(float p) {
    return half_of_code(uint(floor(clamp(p, -1.0, 1.0) * octahedral_center + 0.5) + octahedral_center));
}

vec2 pack_octahedral_normal(vec3 n) {
    const vec2 p = to_octahedron(n);
    return vec2(octahedral_code(p.x), octahedral_code(p.y));
}

// z is extrapolated to the pixel's center and may lie before the near plane, or behind the eye.
float pack_depth(float z) {
    const float share = log2(max(z / view.near, 1.0)) / log2(octahedral_far_over_near);
    return half_of_code(uint(floor(min(share, 1.0) * octahedral_depth_steps + 0.5)));
}

GBufferWords pack_octahedral(MaterialPoint m) {
    return coded_words(pack_octahedral_normal(m.normal), pack_depth(m.position.z), m);
}
