// Tests the bounding sphere of every opaque draw against the view's planes (Gribb and Hartmann 2001) and writes its draw
// command, with no instance when it is outside. Commands keep their places: the order of draws never changes.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "passes/shaders/scene.glsl"
#include "passes/culling/frustum/frustum.shared.h"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) readonly buffer AllCommands { FrustumCommand all_commands[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Commands { FrustumCommand commands[]; };
layout(set = 0, binding = 2, r32ui) writeonly uniform uimage2D visible;
layout(set = 0, binding = 3, scalar) buffer Counters { FrustumCounters counters; };
layout(push_constant, scalar) uniform List { FrustumList list; };

vec4 projection_row(int i) {
    return vec4(view.projection[0][i], view.projection[1][i], view.projection[2][i], view.projection[3][i]);
}

// Strictly behind: a sphere that touches the plane stays.
bool behind(vec4 plane, vec3 center, float radius) {
    return dot(plane.xyz, center) + plane.w < -radius * length(plane.xyz);
}

// No far plane: the projection has none. clip.z <= clip.w is the near plane because depth is reversed.
bool outside(vec3 center, float bound_radius) {
    const float radius = bound_radius + frustum_slack * (1.0 + length(center) + bound_radius);
    const vec4 x = projection_row(0);
    const vec4 y = projection_row(1);
    const vec4 z = projection_row(2);
    const vec4 w = projection_row(3);
    return behind(w + x, center, radius) || behind(w - x, center, radius) || behind(w + y, center, radius) ||
           behind(w - y, center, radius) || behind(w - z, center, radius);
}

void main() {
    const uint width = uint(imageSize(visible).x);
    const uint i = gl_GlobalInvocationID.y * width + gl_GlobalInvocationID.x;
    if (gl_GlobalInvocationID.x >= width || gl_GlobalInvocationID.y >= uint(imageSize(visible).y)) return;
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (i >= list.count) {
        imageStore(visible, texel, uvec4(0u));
        return;
    }
    FrustumCommand command = all_commands[list.first + i];
    const DrawRecord d = draws[command.first_instance];
    const bool culled = outside(d.bound_center, d.bound_radius);
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
