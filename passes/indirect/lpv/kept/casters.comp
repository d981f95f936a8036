// The casters' draw commands, without instances where no grid that their light reaches is lit anew.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/culling/draw_command.shared.h"
#include "passes/indirect/lpv/kept/kept.shared.h"

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push { CastersPush push; };
layout(set = 0, binding = 0, scalar) readonly buffer AllCommands { DrawCommand all_commands[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Starting { uint starting; };
layout(set = 0, binding = 2, scalar) writeonly buffer Commands { DrawCommand commands[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    DrawCommand command = all_commands[push.first + i];
    if ((starting & push.grids) == 0u) command.instance_count = 0u;
    commands[i] = command;
}
