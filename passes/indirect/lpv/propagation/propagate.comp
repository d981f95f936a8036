// One step of propagation: a cell gathers what its six neighbors send through the faces between, each landing on the five other faces of
// this cell (Kaplanyan and Dachsbacher, Cascaded Light Propagation Volumes, I3D 2010; docs/algorithms/lighting.md 5.4). Beyond the border
// nothing comes back.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/lpv/occlusion/links.glsl"
#include "passes/indirect/lpv/propagation/add_to_total.glsl"
#include "passes/indirect/lpv/propagation/read_step.glsl"
#include "passes/indirect/lpv/propagation/write_step.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(push_constant, scalar) uniform Push { GridPlace grid; };

void store(uint cell, uint channel, vec4 gathered) {
    store_step(cell, channel, gathered);
    add_to_channel(cell, channel, step_unit() * gathered);
}

void main() {
    const ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!in_grid(grid, cell)) return;
    vec4 gathered[facing_channels];
    for (uint channel = 0u; channel < channels; ++channel) gathered[channel] = vec4(0.0);
    for (uint i = 0u; i < 6u; ++i) {
        const uint axis = i / 2u;
        const int direction = i % 2u == 0u ? 1 : -1;
        ivec3 from = cell;
        from[axis] -= direction;
        if (!in_grid(grid, from)) continue;
        const float through = transmitted(grid, direction > 0 ? from : cell, axis);
        const uint sender = cell_index(grid, from);
        for (uint channel = 0u; channel < channels; ++channel)
            gathered[channel] += through * sent(before_channel(sender, channel), share_before(sender, channel), axis, float(direction));
    }
    const uint index = cell_index(grid, cell);
    for (uint channel = 0u; channel < channels; ++channel) store(index, channel, gathered[channel]);
}
