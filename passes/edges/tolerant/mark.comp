// A pixel is an edge where the surface of any sample differs visibly from that of sample 0 (docs/algorithms/deferred.md 3.2, D2).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/edges/surface_tests.glsl"

layout(push_constant, scalar) uniform Push { SurfaceLimits limits; };

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    const uint covered = covered_samples(pixel);
    const bool is_full = covered == uint(sample_count());
    mark(pixel, is_partly_covered(covered) || is_full && any_surface_differs(pixel, limits), covered);
}
