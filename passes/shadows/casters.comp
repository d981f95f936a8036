// The casters' draw commands for one shadow map: without instances where the part of the map that is drawn does not see them, or the
// light does not reach them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/culling/draw_command.shared.h"
#include "passes/shaders/map_casters.glsl"
#include "passes/shadows/shadows.shared.h"

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push { MapCastersPush push; };
layout(set = 0, binding = 0, scalar) readonly buffer AllCommands { DrawCommand all_commands[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Commands { DrawCommand commands[]; };
layout(set = 0, binding = 6, scalar) buffer Counters { ShadowCounters counters; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    DrawCommand command = all_commands[push.first + i];
    if (is_seen(push, draws[command.first_instance])) atomicAdd(counters.casters_drawn, 1u);
    else command.instance_count = 0u;
    commands[push.to + i] = command;
}
