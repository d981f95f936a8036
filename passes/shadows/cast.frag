// Only depth is kept; masked casters have holes where the G-buffer has them, at the map's own level of detail. A texel is a pixel
// of one sample: `masked` is clip, mip_coverage or dithered (passes/shadows/shadow_map_params.h).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gbuffer/coverage/coverage.glsl"

layout(location = 0) in vec4 in_uv;
layout(location = 1) in float in_alpha;
layout(location = 2) flat in uint in_draw;
layout(location = 3) flat in uint in_triangle;  // the vertex that it begins with

// Steps of a dither over 4 x 4 texels (Bayer 1973); rows and columns change places by surface, so that layers fill other texels.
float dither_step(uvec2 texel, uint surface) {
    const uvec2 at = texel ^ uvec2(surface, surface >> 2u);
    const uint across = at.x ^ at.y;
    const uint step_number = (across & 1u) << 3u | (at.y & 1u) << 2u | (across & 2u) | (at.y & 2u) >> 1u;
    return (float(step_number) + 0.5) / 16.0;
}

bool is_filled(MaterialRecord material) {
    const uint surface = mask_surface(in_draw, in_triangle);
    if (masked == masked_dithered)
        return alpha_of(material, footprint(in_uv), in_alpha) >= dither_step(uvec2(gl_FragCoord.xy), surface);
    return covered_samples(material, draws[in_draw].material, in_uv, in_alpha, surface) != 0u;
}

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
    const bool filled = is_filled(material);  // of all lanes of the quad: derivatives
    if (is_masked(material) && !filled) discard;
}
