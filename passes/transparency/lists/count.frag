// Counts the fragments of every cell of the band, unshaded: some may turn out invisible, none can be missing.
// Drawn with a depth attachment: lavapipe 22.3 and 25.0 lose side effects under one opaque color attachment without one.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/lists/pixel_lists.shared.h"

layout(push_constant, scalar) uniform Push { Band band; };
#include "passes/transparency/lists/pixel_lists.glsl"

layout(early_fragment_tests) in;
layout(set = 0, binding = 1, scalar) buffer Ends { uint ends[]; };

void main() {
    const uvec2 pixel = uvec2(gl_FragCoord.xy);
    if (!in_band(pixel.y)) return;
    atomicAdd(ends[cell_of(pixel, gl_SampleID)], 1u);
}
