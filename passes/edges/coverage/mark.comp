// Marks what partial.frag noted, and what tests of the surfaces add to it (docs/algorithms/deferred.md 3.2, D3).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/edges/surface_tests.glsl"

layout(set = 0, binding = 3) uniform usampler2D partly;

layout(push_constant, scalar) uniform Push { SurfaceLimits limits; };

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    const uint covered = covered_samples(pixel);
    const bool is_full = covered == uint(sample_count()), is_noted = texelFetch(partly, pixel, 0).r != 0u;
    mark(pixel, is_noted || is_full && any_surface_differs(pixel, limits), covered);
}
