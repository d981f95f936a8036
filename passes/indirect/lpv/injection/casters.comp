// The casters' draw commands for one of a light's maps: without instances where the map's part does not see them, the light does not
// reach them, or no grid of the light is lit anew.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/culling/draw_command.shared.h"
#include "passes/indirect/lpv/kept/kept.shared.h"
#include "passes/shaders/scene.glsl"

layout(local_size_x = 64) in;

layout(constant_id = 0) const uint is_gated = 0u;

layout(push_constant, scalar) uniform Push { MapCastersPush push; };
layout(set = 0, binding = 0, scalar) readonly buffer AllCommands { DrawCommand all_commands[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Starting { uint starting[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Commands { DrawCommand commands[]; };
layout(set = 0, binding = 6, scalar) buffer Counters { LpvCounters counters; };

// Whether a sphere reaches below the plane dot(plane, (p, 1)) = 0; one that is no number does.
bool reaches_below(vec4 plane, vec3 center, float radius) { return !(dot(plane.xyz, center) + plane.w > radius * length(plane.xyz)); }

bool is_seen(vec3 center, float bound_radius) {
    const float away = distance(center, push.light), radius = bound_radius + bound_slack * (1.0 + length(center) + away + bound_radius);
    if (push.range > 0.0 && away - radius > push.range) return false;
    const mat4 rows = transpose(push.to_clip);
    const vec4 x = rows[0], y = rows[1], w = rows[3];
    return reaches_below(-w, center, radius) && reaches_below(x - push.high.x * w, center, radius) &&
           reaches_below(push.low.x * w - x, center, radius) && reaches_below(y - push.high.y * w, center, radius) &&
           reaches_below(push.low.y * w - y, center, radius);
}

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    DrawCommand command = all_commands[push.first + i];
    const bool is_lit_anew = is_gated == 0u || (starting[0] & push.grids) != 0u;
    if (is_lit_anew && is_seen(draws[command.first_instance].bound_center, draws[command.first_instance].bound_radius))
        atomicAdd(counters.map_casters, 1u);
    else command.instance_count = 0u;
    commands[push.to + i] = command;
}
