// What a place takes of the cells of a grid around it, without those that a blocker hides from it (docs/algorithms/lighting.md 5.8).
// A place on a surface is read half a cell before it; one without a normal, (0, 0, 0), where it is, from all directions alike.
// The shader that includes this says where cells lie, light_of(), and where lists of blockers do, listed_blockers().
#ifndef PASSES_INDIRECT_READ_GRID_GLSL
#define PASSES_INDIRECT_READ_GRID_GLSL
#include "passes/indirect/irradiance.glsl"
#include "passes/indirect/near_blockers.glsl"

// The least share of taps that stands for all.
const float least_share = 0.02;

// A cell by its number; the first cells of a grid may not be the first of all.
LightCell light_of(uint number);

LightCell weighted(LightCell sum, LightCell light, float weight) {
    return LightCell(sum.red + weight * light.red, sum.green + weight * light.green, sum.blue + weight * light.blue);
}

struct SeenLight {
    LightCell light;
    uint hidden;  // cells, of eight
    uint tests;   // of a blocker against the way to a cell
    uint near;    // blockers that the ways may meet
};

// The blockers that are asked, and how many they are.
struct NearList {
    uint list, count;
};

// Of a grid whose first cell has this number, some cells before the surface. Beyond the border cells hold nothing.
SeenLight seen_light_at(GridPlace grid, uint first_cell, LitPlace lit, float cells, NearList near) {
    const vec3 between = place_before(grid, lit, cells) - 0.5;
    const ivec3 first = ivec3(floor(between));
    const vec3 share = between - vec3(first);
    SeenLight seen = SeenLight(LightCell(vec4(0.0), vec4(0.0), vec4(0.0)), 0u, 0u, near.count);
    uint hidden = 0u;
    if (near.count > 0u) {
        const vec3 corner = in_view(grid.origin + (vec3(first) + 1.0) * grid.cell);
        hidden = hidden_cells(grid, WaysToCells(first, corner, way_start(lit)), near.list, seen.tests);
    }
    seen.hidden = uint(bitCount(hidden));
    float all = 0.0;
    for (uint i = 0u; i < 8u; ++i) {
        const ivec3 cell = cell_around(first, i);
        const vec3 w = mix(1.0 - share, share, vec3(cell - first));
        const float weight = w.x * w.y * w.z;
        if ((hidden >> i & 1u) != 0u) continue;
        all += weight;
        if (in_grid(grid, cell)) seen.light = weighted(seen.light, light_of(first_cell + cell_index(grid, cell)), weight);
    }
    if (seen.hidden == 0u) return seen;
    const float scale = all < least_share ? 0.0 : 1.0 / all;
    seen.light = LightCell(seen.light.red * scale, seen.light.green * scale, seen.light.blue * scale);
    return seen;
}

#endif
