// Only depth is kept; masked casters have holes where the G-buffer has them, at the map's own level of detail. A texel is a pixel of
// one sample: `masked` is a method of the G-buffer that makes sense there (passes/shadows/shadow_map_params.h).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gbuffer/coverage/coverage.glsl"

layout(location = 0) in vec4 in_uv;
layout(location = 1) in float in_alpha;
layout(location = 2) flat in uint in_draw;
layout(location = 3) flat in uint in_triangle;  // the vertex that it begins with

void cut_by_cutoff(MaterialRecord material) {
    const Footprint uv = footprint(in_uv);
    if (!is_masked(material)) return;
    if (is_cut_away(material, alpha_of(material, uv, in_alpha))) discard;
}

void main() {
    const MaterialRecord material = material_of(in_draw);
    if (masked == masked_clip) {
        cut_by_cutoff(material);
        return;
    }
    const uint surface = mask_surface(in_draw, in_triangle);
    const uint covered = covered_samples(material, draws[in_draw].material, in_uv, in_alpha, surface);
    if (is_masked(material) && covered == 0u) discard;
}
