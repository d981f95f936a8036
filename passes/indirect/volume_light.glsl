// What the frame's light volumes give at any place: for stages after the one that fills them. Each grid takes its share of what the
// grids before it left, as it is with opaque surfaces (docs/algorithms/lighting.md 5.7 and 5.8).
#ifndef PASSES_INDIRECT_VOLUME_LIGHT_GLSL
#define PASSES_INDIRECT_VOLUME_LIGHT_GLSL
#include "passes/indirect/read_grid.glsl"

layout(constant_id = 73) const uint light_grids = 0u;  // in volume_light; 0: none, and nothing of this file runs
layout(set = 0, binding = 30) uniform sampler2D volume_light;

vec4 volume_texel(uint record, uint texel) {
    const uint place = texels_per_record * record + texel;
    return texelFetch(volume_light, ivec2(place % volume_texels_per_row, place / volume_texels_per_row), 0);
}

// Grids have the first records, as if they were cells.
LightCell light_of(uint number) { return LightCell(volume_texel(number, 0u), volume_texel(number, 1u), volume_texel(number, 2u)); }

// All blockers of the frame are asked.
bool is_hidden(uint nearby, vec3 from, vec3 to, inout uint tests) {
    tests += blocker_count;
    return is_stopped(from, to);
}

// Irradiance over pi on a surface; mean radiance at a place without a normal.
vec3 volume_light_at(LitPlace lit) {
    vec3 sum = vec3(0.0);
    float left = 1.0;
    uint first_cell = light_grids;
    for (uint i = 0u; i < light_grids; ++i) {
        const vec4 corner = volume_texel(i, 0u), size = volume_texel(i, 1u);
        const GridPlace grid = GridPlace(corner.xyz, corner.w, uvec3(size.xyz));
        const float share = clamp(depth_inside(grid, lit.place) / size.w, 0.0, 1.0);
        if (share > 0.0) {
            const uint near = volume_texel(i, 2u).x != 0.0 ? blocker_count : 0u;
            const SeenLight seen = seen_light_at(grid, first_cell, lit, 0.5, 0u, near);
            sum += left * share * irradiance_over_pi(grid, seen.light, lit.normal);
            left *= 1.0 - share;
        }
        first_cell += grid.cells.x * grid.cells.y * grid.cells.z;
    }
    return sum;
}

#endif
