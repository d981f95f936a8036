// A pixel is an edge where the depths of its four samples lie on no one plane (docs/algorithms/deferred.md 3.2, D4). Depth after
// projection is affine on the screen, and samples 0 and 3 have the middle of 1 and 2.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/edges/depth/depth.shared.h"
#include "passes/edges/surface_tests.glsl"

layout(set = 0, binding = 3) uniform sampler2DArray depth_layers;

layout(push_constant, scalar) uniform Push { DepthPush push; };

bool is_no_plane(ivec2 pixel) {
    vec4 d;
    for (int i = 0; i < 4; ++i) d[i] = texelFetch(depth_layers, ivec3(pixel, i), 0).r;
    precise const float apart = abs((d.x - d.y) - (d.z - d.w));
    return apart > push.residual * max(max(d.x, d.y), max(d.z, d.w));
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    const uint covered = covered_samples(pixel);
    const bool is_full = covered == uint(sample_count());
    const bool differs = is_full && (is_no_plane(pixel) || any_surface_differs(pixel, push.limits));
    mark(pixel, is_partly_covered(covered) || differs, covered);
}
