// What the frame's light volumes give at any place: for stages after the one that fills them. Each grid takes its share of what the
// grids before it left, as it is with opaque surfaces (docs/algorithms/lighting.md 5.7 and 5.8).
#ifndef PASSES_INDIRECT_VOLUME_LIGHT_GLSL
#define PASSES_INDIRECT_VOLUME_LIGHT_GLSL
#include "passes/indirect/read_grid.glsl"

layout(constant_id = 73) const uint light_grids = 0u;  // in volume_light; 0: none, and nothing of this file runs
layout(set = 0, binding = 30) uniform sampler2D volume_light;

vec4 volume_texel(uint place) { return texelFetch(volume_light, ivec2(place % volume_texels_per_row, place / volume_texels_per_row), 0); }

vec4 record_texel(uint record, uint texel) { return volume_texel(texels_per_record * record + texel); }

// Grids have the first records, as if they were cells.
vec4 grid_texel(uint grid, uint texel) { return record_texel(records_per_grid * grid, texel); }

LightCell light_of(uint number) { return LightCell(record_texel(number, 0u), record_texel(number, 1u), record_texel(number, 2u)); }

LightCell facing_of(uint number) { return light_of(number); }

// A list is named by its first texel.
uint listed_blockers(uint list, uint word) {
    const vec4 words = volume_texel(list + word / list_words_per_texel);
    vec2 halves = words.xy;
    if (word % list_words_per_texel != 0u) halves = words.zw;
    return uint(halves.x) | uint(halves.y) << 16u;
}

// Blockers near a place in a grid, which is given by its number.
NearList near_list(GridPlace grid, LitPlace lit, uint number) {
    const vec4 rule = grid_texel(number, 2u);
    if (rule.x == 0.0) return NearList(all_listed, 0u);
    uint list = all_listed;
    if (rule.w > 0.0)
        list = uint(rule.w) * volume_texels_per_row + macro_cell_before(grid, lit, grid_texel(number, 3u).x) * texels_per_list;
    return NearList(list, count_near(list));
}

// Irradiance over pi on a surface; mean radiance at a place without a normal.
vec3 volume_light_at(LitPlace lit) {
    vec3 sum = vec3(0.0);
    float left = 1.0;
    uint first_cell = records_per_grid * light_grids;
    for (uint i = 0u; i < light_grids; ++i) {
        const vec4 corner = grid_texel(i, 0u), size = grid_texel(i, 1u), read = grid_texel(i, 3u);
        const GridPlace grid = GridPlace(corner.xyz, corner.w, uvec3(size.xyz));
        const uint cells = grid.cells.x * grid.cells.y * grid.cells.z;
        const float share = clamp(depth_inside(grid, lit.place) / size.w, 0.0, 1.0);
        if (share > 0.0) {
            const GridReading reading =
                GridReading(first_cell, read.y != 0.0 ? first_cell + cells : nowhere, read.x, near_list(grid, lit, i));
            sum += left * share * received_light(grid, seen_light_at(grid, lit, reading), reading.first_facing, lit.normal);
            left *= 1.0 - share;
        }
        first_cell += read.y != 0.0 ? 2u * cells : cells;
    }
    return sum;
}

#endif
