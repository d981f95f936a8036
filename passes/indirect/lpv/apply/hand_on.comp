// A grid after propagation, for stages after this one: its records and those of its cells in the image volume_light.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/grid.glsl"
#include "passes/indirect/lpv/read_total.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(push_constant, scalar) uniform Push { HandOnPush push; };

layout(set = 0, binding = 1, rgba32f) writeonly uniform image2D volume_light;

void store(uint record, vec4 a, vec4 b, vec4 c) {
    const vec4 texels[texels_per_record] = {a, b, c};
    for (uint i = 0u; i < texels_per_record; ++i) {
        const uint place = texels_per_record * record + i;
        imageStore(volume_light, ivec2(place % volume_texels_per_row, place / volume_texels_per_row), texels[i]);
    }
}

void main() {
    const ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!in_grid(push.grid, cell)) return;
    const uint index = cell_index(push.grid, cell);
    const LightCell light = total_light(index);
    store(push.first_cell + index, light.red, light.green, light.blue);
    if (knows_facing()) {
        const LightCell facing = total_facing(index);
        store(push.first_cell + push.grid.cells.x * push.grid.cells.y * push.grid.cells.z + index, facing.red, facing.green, facing.blue);
    }
    if (index > 0u) return;
    store(records_per_grid * push.number, vec4(push.grid.origin, push.grid.cell), vec4(push.grid.cells, push.border),
          vec4(push.asks_taps, push.irradiance, push.count, push.macro_row));
    store(records_per_grid * push.number + 1u, vec4(push.reading, knows_facing() ? 1.0 : 0.0, 0.0, 0.0), vec4(0.0), vec4(0.0));
}
