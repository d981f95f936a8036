// What surfaces and blockers let through between a cell and its next neighbor along an axis. Surfaces: the mean over the corners of the
// face between, of the worse of the two directions, stops light (docs/algorithms/lighting.md 5.5 and 5.6).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/lpv/occlusion/links.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(push_constant, scalar) uniform Push { GridPlace grid; };
layout(set = 0, binding = 0, scalar) readonly buffer Cover { int cover[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer FuzzyLinks { float fuzzy_links[]; };  // as Links

float covered(ivec3 cell, uint axis, uint direction) {
    const ivec3 corners = ivec3(grid.cells) + 1;
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec3 corner = cell;
        ++corner[axis];
        corner[(axis + 1u) % 3u] += i & 1;
        corner[(axis + 2u) % 3u] += i >> 1;
        sum += float(cover[6 * ((corner.z * corners.y + corner.y) * corners.x + corner.x) + int(2u * axis + direction)]);
    }
    return sum / (4.0 * cover_one);
}

void main() {
    const ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!in_grid(grid, cell)) return;
    for (uint axis = 0u; axis < 3u; ++axis) {
        const float stopped = clamp(max(covered(cell, axis, 0u), covered(cell, axis, 1u)), 0.0, 1.0);
        fuzzy_links[3u * cell_index(grid, cell) + axis] = transmitted(grid, cell, axis) * (1.0 - stopped);
    }
}
