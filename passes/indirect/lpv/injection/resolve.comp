// What was injected, as numbers: the light of step 0, and what is accumulated so far.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/indirect/grid.glsl"
#include "passes/indirect/lpv/propagation/faces.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(push_constant, scalar) uniform Push { ResolvePush push; };
layout(set = 0, binding = 0, scalar) readonly buffer Sums { ivec4 sums[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Step { StepCell cells[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Scale { float fixed_one; };
layout(constant_id = 3) const uint has_scale = 0u;  // 1: the fixed point is known on the device alone
layout(set = 0, binding = 2, scalar) writeonly buffer Total { LightCell total[]; };
layout(set = 0, binding = 6, scalar) buffer Counters { LpvCounters counters; };

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (!in_grid(push.grid, at)) return;
    const uint cell = cell_index(push.grid, at);
    float unit = 1.0 / push.fixed_one;
    if (has_scale != 0u) unit = 1.0 / fixed_one;
    const LightCell light = LightCell(vec4(sums[3u * cell]) * unit, vec4(sums[3u * cell + 1u]) * unit, vec4(sums[3u * cell + 2u]) * unit);
    cells[cell] = with_share(light);
    total[cell] = light;
    atomicAdd(counters.cells_relit, 1u);
}
