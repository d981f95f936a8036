// Tests the bounding sphere of every opaque draw against the view's planes (Gribb and Hartmann 2001) and writes its draw
// command, with no instance when it is outside. Commands keep their places: the order of draws never changes.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "passes/culling/view_planes.glsl"
#include "passes/culling/frustum/frustum.shared.h"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) readonly buffer AllCommands { DrawCommand all_commands[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Commands { DrawCommand commands[]; };
layout(set = 0, binding = 2, r32ui) writeonly uniform uimage2D visible;
layout(set = 0, binding = 3, scalar) buffer Counters { FrustumCounters counters; };
layout(push_constant, scalar) uniform List { FrustumList list; };

void main() {
    const uint width = uint(imageSize(visible).x);
    const uint i = gl_GlobalInvocationID.y * width + gl_GlobalInvocationID.x;
    if (gl_GlobalInvocationID.x >= width || gl_GlobalInvocationID.y >= uint(imageSize(visible).y)) return;
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (i >= list.count) {
        imageStore(visible, texel, uvec4(0u));
        return;
    }
    DrawCommand command = all_commands[list.first + i];
    const DrawRecord d = draws[command.first_instance];
    const bool culled = outside(d.bound_center, padded_radius(d.bound_center, d.bound_radius));
    if (culled) command.instance_count = 0u;
    commands[i] = command;
    imageStore(visible, texel, uvec4(culled ? 0u : 1u));

    const uint tested_here = subgroupAdd(1u);
    const uint culled_here = subgroupAdd(culled ? 1u : 0u);
    if (subgroupElect()) {
        atomicAdd(counters.tested, tested_here);
        atomicAdd(counters.culled, culled_here);
    }
}
