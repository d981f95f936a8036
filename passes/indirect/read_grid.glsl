// What a place takes of the cells of a grid around it, without those that a blocker hides from it (docs/algorithms/lighting.md 5.8).
// A place on a surface is read half a cell before it; one without a normal, (0, 0, 0), where it is, from all directions alike.
// The shader that includes this says where cells lie, light_of() and facing_of(), and where lists of blockers do, listed_blockers().
#ifndef PASSES_INDIRECT_READ_GRID_GLSL
#define PASSES_INDIRECT_READ_GRID_GLSL
#include "passes/indirect/irradiance.glsl"
#include "passes/indirect/near_blockers.glsl"

// The least share of taps that stands for all.
const float least_share = 0.02;

// A cell by its number; the first cells of a grid may not be the first of all.
LightCell light_of(uint number);
LightCell facing_of(uint number);

LightCell weighted(LightCell sum, LightCell light, float weight) {
    return LightCell(sum.red + weight * light.red, sum.green + weight * light.green, sum.blue + weight * light.blue);
}

struct SeenLight {
    LightCell light;
    LightCell facing;  // by the way that sources face; not set where the grid does not know it
    uint hidden;  // cells, of eight
    uint tests;   // of a blocker against the way to a cell
    uint near;    // blockers that the ways may meet
};

// The blockers that are asked, and how many they are.
struct NearList {
    uint list, count;
};

// Parts of a grid that are read: the numbers of its first cell and of the first that says which way sources face, or nowhere; how many cells before
// the surface.
struct GridReading {
    uint first_cell, first_facing;
    float cells;
    NearList near;
};

// Beyond the border cells hold nothing.
SeenLight seen_light_at(GridPlace grid, LitPlace lit, GridReading reading) {
    const NearList near = reading.near;
    const vec3 between = place_before(grid, lit, reading.cells) - 0.5;
    const ivec3 first = ivec3(floor(between));
    const vec3 share = between - vec3(first);
    const LightCell dark = LightCell(vec4(0.0), vec4(0.0), vec4(0.0));
    SeenLight seen = SeenLight(dark, dark, 0u, 0u, near.count);
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
        if (!in_grid(grid, cell)) continue;
        const uint index = cell_index(grid, cell);
        seen.light = weighted(seen.light, light_of(reading.first_cell + index), weight);
        if (reading.first_facing != nowhere) seen.facing = weighted(seen.facing, facing_of(reading.first_facing + index), weight);
    }
    if (seen.hidden == 0u) return seen;
    const float scale = all < least_share ? 0.0 : 1.0 / all;
    seen.light = weighted(dark, seen.light, scale);
    seen.facing = weighted(dark, seen.facing, scale);
    return seen;
}

// Irradiance over pi of what was read.
vec3 received_light(GridPlace grid, SeenLight seen, uint first_facing, vec3 n) {
    const vec3 received = irradiance_over_pi(grid, seen.light, n);
    if (first_facing == nowhere) return received;
    return received * share_by_facing(seen.light, seen.facing, n);
}

#endif
