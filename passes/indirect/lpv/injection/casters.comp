// The casters' draw commands for one of a light's maps: without instances where the map's part does not see them, the light does not
// reach them, or no grid of the light is lit anew.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/culling/draw_command.shared.h"
#include "passes/indirect/lpv/kept/kept.shared.h"
#include "passes/shaders/map_casters.glsl"

layout(local_size_x = 64) in;

layout(constant_id = 0) const uint is_gated = 0u;

layout(push_constant, scalar) uniform Push { LitCastersPush push; };
layout(set = 0, binding = 0, scalar) readonly buffer AllCommands { DrawCommand all_commands[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Starting { uint starting[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Commands { DrawCommand commands[]; };
layout(set = 0, binding = 6, scalar) buffer Counters { LpvCounters counters; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= push.casters.count) return;
    DrawCommand command = all_commands[push.casters.first + i];
    const bool is_lit_anew = is_gated == 0u || (starting[0] & push.grids) != 0u;
    if (is_lit_anew && is_seen(push.casters, draws[command.first_instance]))
        atomicAdd(counters.map_casters, 1u);
    else command.instance_count = 0u;
    commands[push.casters.to + i] = command;
}
