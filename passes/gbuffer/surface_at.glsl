// The surface of a sample, out of the G-buffer that the frame has, whichever layout wrote it. passes/gbuffer/surface_at.h binds it.
#ifndef PASSES_GBUFFER_SURFACE_AT_GLSL
#define PASSES_GBUFFER_SURFACE_AT_GLSL
#include "passes/gbuffer/surface.glsl"
#include "passes/gbuffer/decoders.glsl"

layout(constant_id = 30) const uint gbuffer_layout = 0u;

layout(set = 0, binding = 20) uniform sampler2DArray gbuffer0;
layout(set = 0, binding = 21) uniform sampler2DArray gbuffer1;
layout(set = 0, binding = 22) uniform sampler2DArray gbuffer2;

// x and y: the pixel; z: the sample.
Surface surface_at(ivec3 at) {
    return decode_gbuffer(gbuffer_layout, texelFetch(gbuffer0, at, 0), texelFetch(gbuffer1, at, 0), texelFetch(gbuffer2, at, 0),
                          vec2(at.xy) + 0.5);
}

#endif
