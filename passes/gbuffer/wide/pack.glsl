// Packs a surface as layout A of docs/algorithms/deferred.md 2.1 (Lobanchikov and Gruen, S.T.A.L.K.E.R.: Clear Sky, 2009: the
// layout before it was optimized).
#include "passes/gbuffer/half_depth.glsl"
#include "passes/gbuffer/packed_words.glsl"
#include "passes/gbuffer/wide/wide.shared.h"

float pack_wide_material(float metallic, uint lighting_model) {
    const uint step = uint(floor(clamp(metallic, 0.0, 1.0) * float(wide_metallic_steps - 1u) + 0.5));
    return half_of_code(lighting_model * wide_metallic_steps + step);
}

GBufferWords pack_wide(MaterialPoint m) {
    GBufferWords words;
    const vec3 position = vec3(nearest_half(m.position.xy), pack_half_depth(m.position.z));
    words.g0 = vec4(position, pack_wide_material(m.metallic, m.lighting_model));
    words.g1 = vec4(nearest_half(m.normal), nearest_half(clamp(m.occlusion, 0.0, 1.0)));
    words.g2 = pack_color(m.base_color, m.roughness);
    return words;
}
