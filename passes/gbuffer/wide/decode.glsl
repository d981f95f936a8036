// Decodes layout A of docs/algorithms/deferred.md 2.1: position and normal as half floats.
#include "passes/gbuffer/codes.glsl"
#include "passes/gbuffer/wide/wide.shared.h"

// The position is stored whole, so it misses the ray of its pixel: by how many pixels.
vec2 wide_offset(vec3 position, vec2 center) {
    const vec2 aside = position.xy / position.z - view_ray(center).xy;
    return vec2(0.5, -0.5) * aside * view.ndc_scale * vec2(view.extent);
}

Surface decode_wide(GBufferTexel t) {
    if (t.g0.a == 0.0) return no_surface();
    const uint code = code_of_half(t.g0.a);
    const vec4 color = unpack_color(t.g2);
    const float metallic = float(code % wide_metallic_steps) / float(wide_metallic_steps - 1u);
    return Surface(true, normalize(t.g1.xyz), t.g0.z, color.rgb, color.a, metallic, t.g1.a, code / wide_metallic_steps,
                   wide_offset(t.g0.xyz, t.center));
}
