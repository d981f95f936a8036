// Phase 2: what phase 1 has not drawn and does not hide is drawn into the same depth.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/culling/draw_command.shared.h"
#include "passes/culling/hiz_two_phase/hiz_two_phase.shared.h"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) readonly buffer AllCommands { DrawCommand all_commands[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Commands { DrawCommand commands[]; };
layout(set = 0, binding = 2, scalar) buffer HizDraws { HizDraw hiz_draws[]; };
layout(set = 0, binding = 3, scalar) buffer Work { HizWork work; };
layout(set = 0, binding = 4, scalar) readonly buffer Pyramid { float pyramid[]; };
layout(set = 0, binding = 5, scalar) buffer Counters { HizCounters counters; };
layout(push_constant, scalar) uniform Push { HizPush push; };
#include "passes/culling/hiz_two_phase/occlusion.glsl"

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    const HizDraw draw = hiz_draws[i];
    if ((draw.state & hiz_in_view) == 0u || (draw.state & hiz_first) != 0u) return;
    atomicAdd(counters.tested, 1u);
    if (is_hidden(draw, push.across)) return;
    hiz_draws[i].state = draw.state | hiz_new;
    atomicAdd(counters.newly_visible, 1u);
    if ((draw.state & hiz_occludes) != 0u) commands[atomicAdd(work.second_count, 1u)] = all_commands[push.first + i];
}
