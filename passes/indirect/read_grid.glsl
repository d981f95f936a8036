// What a place takes of the cells of a grid around it, without those that a blocker hides from it (docs/algorithms/lighting.md 5.8).
// A place on a surface is read half a cell before it; one without a normal, (0, 0, 0), where it is, from all directions alike.
// The shader that includes this says where cells lie: light_of().
#ifndef PASSES_INDIRECT_READ_GRID_GLSL
#define PASSES_INDIRECT_READ_GRID_GLSL
#include "passes/indirect/grid.glsl"
#include "passes/indirect/ways.glsl"

layout(constant_id = 72) const uint irradiance = irradiance_face;

// Metres off the surface from which taps are asked about, and the least share of taps that stands for all.
const float tap_start = 0.02;
const float least_share = 0.02;

// A cell by its number; the first cells of a grid may not be the first of all.
LightCell light_of(uint number);

LightCell weighted(LightCell sum, LightCell light, float weight) {
    return LightCell(sum.red + weight * light.red, sum.green + weight * light.green, sum.blue + weight * light.blue);
}

struct LitPlace {
    vec3 place, normal;
};

// How far a place is from the grid's border, metres; below 0 outside.
float depth_inside(GridPlace grid, vec3 place) {
    const vec3 least = min(place - grid.origin, grid.origin + vec3(grid.cells) * grid.cell - place);
    return min(least.x, min(least.y, least.z));
}

struct SeenLight {
    LightCell light;
    uint hidden;  // cells, of eight
};

// Beyond the border cells hold nothing. asks_taps: not of cells that a blocker hides.
SeenLight seen_light(GridPlace grid, uint first_cell, LitPlace lit, bool asks_taps) {
    const vec3 start = in_view(lit.place + lit.normal * tap_start);
    const vec3 between = (lit.place - grid.origin) / grid.cell + 0.5 * lit.normal - 0.5;
    const ivec3 first = ivec3(floor(between));
    const vec3 share = between - vec3(first);
    LightCell sum = LightCell(vec4(0.0), vec4(0.0), vec4(0.0));
    float all = 0.0;
    uint hidden = 0u;
    for (uint i = 0u; i < 8u; ++i) {
        const ivec3 corner = ivec3(i & 1u, i >> 1u & 1u, i >> 2u);
        const vec3 w = mix(1.0 - share, share, vec3(corner));
        const float weight = w.x * w.y * w.z;
        const ivec3 cell = first + corner;
        if (asks_taps && is_stopped(start, in_view(middle_of(grid, cell)))) {
            ++hidden;
            continue;
        }
        all += weight;
        if (in_grid(grid, cell)) sum = weighted(sum, light_of(first_cell + cell_index(grid, cell)), weight);
    }
    if (hidden == 0u) return SeenLight(sum, 0u);
    const float scale = all < least_share ? 0.0 : 1.0 / all;
    return SeenLight(LightCell(sum.red * scale, sum.green * scale, sum.blue * scale), hidden);
}

// Irradiance over pi, where cells are a metre wide (docs/algorithms/lighting.md 5.8). face: of a light half a cell away that sends as much as the
// cell towards the surface. cell: of light through all of the cell's section, which is 1.5 square metres in the mean. Without a normal
// only l0 is left: the mean over all normals, which is the mean radiance.
float towards(vec4 light, vec3 n) {
    const float face = (4.0 / 3.14159265358979) * (y0 * light.x - y1 * dot(light.yzw, n));
    const float cell = (watt0 * light.x - watt1 * dot(light.yzw, n)) / 1.5;
    return max(0.0, irradiance == irradiance_face ? face : cell);
}

vec3 irradiance_over_pi(GridPlace grid, LightCell light, vec3 n) {
    const float scale = 1.0 / (grid.cell * grid.cell);
    return scale * vec3(towards(light.red, n), towards(light.green, n), towards(light.blue, n));
}

#endif
