// For a view: the bits of the least optical depth in front of a pixel's fragments. T never rises, so it is the nearest's.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/fragment.glsl"
#include "passes/transparency/functions/outputs.glsl"
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/volume/read.glsl"

layout(early_fragment_tests) in;
layout(set = 0, binding = 21, r32ui) uniform uimage2DArray least_read;

void main() {
    const Fragment fragment = transparent_fragment();
    if (!fragment.visible) discard;
    const vec3 through = transmittance_before(fragment);
    const float t = min(through.r, min(through.g, through.b));
    const float depth = t > 0.0 ? abs(log(t)) : log(float(full_integral()));
    imageAtomicMin(least_read, ivec3(gl_FragCoord.xy, 0), floatBitsToUint(depth));
}
