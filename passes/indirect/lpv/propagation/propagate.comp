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
    LightCell gathered = LightCell(vec4(0.0), vec4(0.0), vec4(0.0));
    for (uint i = 0u; i < 6u; ++i) {
        const uint axis = i / 2u;
        const int direction = i % 2u == 0u ? 1 : -1;
        ivec3 from = cell;
        from[axis] -= direction;
        if (!in_grid(grid, from)) continue;
        const float through = transmitted(grid, direction > 0 ? from : cell, axis);
        const StepCell s = step_before(cell_index(grid, from));
        gathered.red += through * sent(s.light.red, s.share[0], axis, float(direction));
        gathered.green += through * sent(s.light.green, s.share[1], axis, float(direction));
        gathered.blue += through * sent(s.light.blue, s.share[2], axis, float(direction));
    }
    const uint index = cell_index(grid, cell);
    store(index, 0u, gathered.red);
    store(index, 1u, gathered.green);
    store(index, 2u, gathered.blue);
}
