// Draws of phase 1: what was visible the last time, and where nothing is known (or in one phase) the largest. Their order does
// not matter, for depth alone is drawn: commands are packed, and empty ones follow them.
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
layout(set = 0, binding = 4, scalar) buffer Counters { HizCounters counters; };
layout(push_constant, scalar) uniform Push { HizPush push; };

// Whole bins from the largest on: at least one, and more of them as long as they hold no more draws than wanted.
uint smallest_chosen_bin() {
    uint smallest = size_bins;
    uint sum = 0u;
    for (uint bin = size_bins; bin-- > 0u;) {
        if (sum > 0u && sum + work.sizes[bin] > push.occluders) break;
        sum += work.sizes[bin];
        smallest = bin;
    }
    return smallest;
}

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    const HizDraw draw = hiz_draws[i];
    if ((draw.state & hiz_occludes) == 0u) return;
    const bool warm = push.phases == phases_two && work.known > 0u;
    const bool chosen = warm ? (draw.state & hiz_known) != 0u : draw.size_bin >= smallest_chosen_bin();
    if (!chosen) return;
    hiz_draws[i].state = draw.state | hiz_first;
    commands[atomicAdd(work.first_count, 1u)] = all_commands[push.first + i];
    atomicAdd(counters.drawn_first, 1u);
}
