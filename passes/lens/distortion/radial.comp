// Radial distortion (Brown 1966; docs/algorithms/deferred.md 8.8): where r is the distance from the middle of the picture in halves of
// its diagonal, a pixel shows what a lens without distortion has at s (1 + k1 r^2) times its distance.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lens/samples.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 1, rgba32f) writeonly uniform image2DArray distorted;
layout(push_constant, scalar) uniform Push { RadialPush push; };

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID), size = imageSize(distorted);
    if (any(greaterThanEqual(at, size))) return;
    const vec2 middle = 0.5 * vec2(size.xy), off = vec2(at.xy) + 0.5 - middle;
    const float r2 = dot(off, off) / dot(middle, middle);
    imageStore(distorted, at, vec4(mixed(middle + off * (push.scale * (1.0 + push.k1 * r2)), at.z), 1.0));
}
