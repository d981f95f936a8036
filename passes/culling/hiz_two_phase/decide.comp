// What is not hidden by the depth of all occluders is drawn, and known to the next frame. Commands keep their places: the order
// of draws never changes.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/culling/draw_command.shared.h"
#include "passes/culling/hiz_two_phase/hiz_two_phase.shared.h"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) readonly buffer AllCommands { DrawCommand all_commands[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Commands { DrawCommand commands[]; };
layout(set = 0, binding = 2, scalar) buffer HizDraws { HizDraw hiz_draws[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer History { uint visible_before[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Pyramid { float pyramid[]; };
layout(set = 0, binding = 5, r32ui) writeonly uniform uimage2D visible;
layout(set = 0, binding = 6, scalar) buffer Counters { HizCounters counters; };
layout(push_constant, scalar) uniform Push { HizPush push; };
#include "passes/culling/hiz_two_phase/occlusion.glsl"

// What phase 2 found hidden still is: its depth only came nearer.
bool is_visible(HizDraw draw) {
    if ((draw.state & hiz_in_view) == 0u) return false;
    if (push.phases == phases_two && (draw.state & (hiz_first | hiz_new)) == 0u) return false;
    return !is_hidden(draw, push.across);
}

void main() {
    const uint width = uint(imageSize(visible).x);
    const uint i = gl_GlobalInvocationID.y * width + gl_GlobalInvocationID.x;
    if (gl_GlobalInvocationID.x >= width || gl_GlobalInvocationID.y >= uint(imageSize(visible).y)) return;
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (i >= push.count) {
        imageStore(visible, texel, uvec4(0u));
        return;
    }
    const HizDraw draw = hiz_draws[i];
    const bool drawn = is_visible(draw);
    DrawCommand command = all_commands[push.first + i];
    if (!drawn) command.instance_count = 0u;
    commands[i] = command;
    visible_before[i] = drawn ? 1u : 0u;
    imageStore(visible, texel, uvec4(drawn ? 1u : 0u));
    if (drawn) hiz_draws[i].state = draw.state | hiz_visible;
    else if ((draw.state & hiz_in_view) != 0u) atomicAdd(counters.occluded, 1u);
}
