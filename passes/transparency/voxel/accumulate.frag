// Weights every fragment by what the volume lets through in front of it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/fragment.glsl"
#include "passes/transparency/functions/outputs.glsl"
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/volume/read.glsl"

layout(early_fragment_tests) in;
layout(set = 0, binding = 20, scalar) buffer Counters { VoxelCounters counters; };

void main() {
    const Fragment fragment = transparent_fragment();
    if (!fragment.visible) discard;
    const vec3 through = transmittance_before(fragment);
    if (through == vec3(0.0)) {  // adds nothing, optical depth included: whether it is culled makes no difference
        atomicAdd(counters.unseen, 1u);
        discard;
    }
    atomicAdd(counters.function.drawn, 1u);
    if (is_clamped(fragment)) atomicAdd(counters.function.clamped, 1u);
    write_fragment(fragment, through);
}
