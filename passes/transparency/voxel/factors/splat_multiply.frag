// What a fragment lets through, multiplied by the blending into its triangle's slice (docs/algorithms/transparency.md 6.4). Every
// attachment of a layered draw has as many layers, so opaque depth is tested here.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/luminance.glsl"
#include "passes/transparency/fragment.glsl"
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };

layout(location = 0) out vec4 out_factor;

void main() {
    const Fragment fragment = transparent_fragment();
    const bool hidden = gl_FragCoord.z < texelFetch(depth_layers, ivec3(gl_FragCoord.xy, 0), 0).r;
    if (hidden || !fragment.visible) discard;
    out_factor = push.channels == 1u ? vec4(luminance(fragment.t)) : vec4(fragment.t, 1.0);
}
