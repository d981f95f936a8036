// The surface of a sample, out of the G-buffer that the frame has, whichever layout wrote it. passes/gbuffer/surface_at.h binds it.
#ifndef PASSES_GBUFFER_SURFACE_AT_GLSL
#define PASSES_GBUFFER_SURFACE_AT_GLSL
#include "passes/gbuffer/layout.shared.h"
#include "passes/gbuffer/place.glsl"
#include "passes/gbuffer/surface.glsl"
#include "passes/gbuffer/words.glsl"
#include "passes/gbuffer/decoders.glsl"
#include "passes/shaders/sample_places.glsl"

layout(constant_id = 30) const uint gbuffer_layout = 0u;  // layout.shared.h

layout(set = 0, binding = 25) uniform sampler2DArray gbuffer_depth;

// Surfaces as they are given in floats (passes/gbuffer/surfaces.h).
Surface decode_surfaces(GBufferTexel t) {
    if (!(t.g0.w > 0.0)) return no_surface();
    return Surface(true, t.g0.xyz, t.g0.w, t.g1.rgb, t.g1.a, t.g2.y, t.g2.z, uint(t.g2.x), offset_of_place_code(t.g2.w));
}

// x and y: the pixel; z: the sample.
Surface surface_at(ivec3 at) {
    GBufferTexel t;
    t.g0 = texelFetch(gbuffer0, at, 0);
    t.g1 = texelFetch(gbuffer1, at, 0);
    t.g2 = texelFetch(gbuffer2, at, 0);
    t.depth = 0.0;
    t.center = vec2(at.xy) + 0.5;
    t.shaded_offset = vec2(0.0);
    t.sample_offset = vec2(0.0);
    if ((gbuffer_layout & layout_reads_depth) != 0u) {
        t.depth = texelFetch(gbuffer_depth, at, 0).r;
        t.sample_offset = sample_place(view.samples, uint(at.z));
    }
    if ((gbuffer_layout & layout_shaded_at_sample) != 0u) t.shaded_offset = sample_place(view.samples, uint(at.z));
    if ((gbuffer_layout & layout_index_mask) == layout_decoded) return decode_surfaces(t);
    return decode_gbuffer(gbuffer_layout & layout_index_mask, t);
}

#endif
