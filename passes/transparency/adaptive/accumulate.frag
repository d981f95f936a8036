// T(z) is that of the last node in front. Draws at half resolution look it up in a pixel under their center.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/adaptive/adaptive.shared.h"
#include "passes/transparency/fragment.glsl"
#include "passes/transparency/functions/outputs.glsl"
#include "passes/transparency/lists/pixel_lists.shared.h"

layout(push_constant, scalar) uniform Push { Band band; };
#include "passes/transparency/lists/pixel_lists.glsl"

layout(early_fragment_tests) in;
layout(set = 0, binding = 20, scalar) buffer Counters { FunctionCounters counters; };
layout(constant_id = 10) const uint curve_nodes = 8u;
layout(set = 0, binding = 1, scalar) readonly buffer Curves { CurveNode curves[]; };

vec3 transmittance(uint cell, float z) {
    const uint first = cell * curve_nodes;
    vec3 through = vec3(1.0);
    for (uint i = 0u; i < curve_nodes; ++i) {
        const CurveNode node = curves[first + i];
        if (node.z < z) through = node.t;
    }
    return through;
}

void main() {
    const Fragment fragment = transparent_fragment();
    const uvec2 pixel = texel_under(view.extent);
    if (!fragment.visible || !in_band(pixel.y)) discard;
    atomicAdd(counters.drawn, 1u);
    if (is_clamped(fragment)) atomicAdd(counters.clamped, 1u);
    write_fragment(fragment, transmittance(cell_of(pixel, gl_SampleID), fragment.z));
}
