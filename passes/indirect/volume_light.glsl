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
LightCell light_of(uint number) { return LightCell(record_texel(number, 0u), record_texel(number, 1u), record_texel(number, 2u)); }

// A list is named by its first texel.
uint listed_blockers(uint list, uint word) {
    const vec4 words = volume_texel(list + word / list_words_per_texel);
    vec2 halves = words.xy;
    if (word % list_words_per_texel != 0u) halves = words.zw;
    return uint(halves.x) | uint(halves.y) << 16u;
}

// rule: the third texel of the grid's record.
NearList near_list(GridPlace grid, LitPlace lit, vec4 rule) {
    if (rule.x == 0.0) return NearList(all_listed, 0u);
    uint list = all_listed;
    if (rule.w > 0.0) list = uint(rule.w) * volume_texels_per_row + macro_cell_before(grid, lit, 0.5) * texels_per_list;
    return NearList(list, count_near(list));
}

// Irradiance over pi on a surface; mean radiance at a place without a normal.
vec3 volume_light_at(LitPlace lit) {
    vec3 sum = vec3(0.0);
    float left = 1.0;
    uint first_cell = light_grids;
    for (uint i = 0u; i < light_grids; ++i) {
        const vec4 corner = record_texel(i, 0u), size = record_texel(i, 1u);
        const GridPlace grid = GridPlace(corner.xyz, corner.w, uvec3(size.xyz));
        const float share = clamp(depth_inside(grid, lit.place) / size.w, 0.0, 1.0);
        if (share > 0.0) {
            const SeenLight seen = seen_light_at(grid, first_cell, lit, 0.5, near_list(grid, lit, record_texel(i, 2u)));
            sum += left * share * irradiance_over_pi(grid, seen.light, lit.normal);
            left *= 1.0 - share;
        }
        first_cell += grid.cells.x * grid.cells.y * grid.cells.z;
    }
    return sum;
}

#endif
