// What a surface sees of the cells around a place half a cell before it, without those that a blocker hides from it
// (docs/algorithms/lighting.md 5.8).
#ifndef PASSES_INDIRECT_LPV_TAPS_GLSL
#define PASSES_INDIRECT_LPV_TAPS_GLSL
#include "passes/gbuffer/surface.glsl"
#include "passes/indirect/lpv/grid.glsl"
#include "passes/indirect/lpv/apply/near_blockers.glsl"

layout(constant_id = 3) const uint asks_taps = 0u;  // 1: not of cells that a blocker hides

layout(set = 0, binding = 0, scalar) readonly buffer Total { LightCell total[]; };

// The least share of taps that stands for all.
const float least_share = 0.02;
LightCell weighted(LightCell sum, LightCell light, float weight) {
    return LightCell(sum.red + weight * light.red, sum.green + weight * light.green, sum.blue + weight * light.blue);
}

struct LitPlace {
    vec3 place, normal;
};

LitPlace lit_place(Surface s, uvec2 pixel) {
    const MaterialPoint m = lit_point(s, pixel);
    return LitPlace(view.to_world * m.position, view.to_world * facing_normal(m.lighting_model, m.normal, m.position));
}

// How far a place is from the grid's border, metres; below 0 outside.
float depth_inside(GridPlace grid, vec3 place) {
    const vec3 least = min(place - grid.origin, grid.origin + vec3(grid.cells) * grid.cell - place);
    return min(least.x, min(least.y, least.z));
}

// Some cells before the surface, in cells from the grid's origin.
vec3 place_before(GridPlace grid, LitPlace lit, float cells) { return (lit.place - grid.origin) / grid.cell + cells * lit.normal; }

// The macro-cell of the place half a cell before the surface, or behind it for -0.5.
uint macro_cell_before(GridPlace grid, LitPlace lit, float cells) { return macro_cell(grid, ivec3(floor(place_before(grid, lit, cells)))); }

// Where ways from the surface begin, view space.
vec3 way_start(LitPlace lit) { return in_view(lit.place + lit.normal * tap_start); }

struct SeenLight {
    LightCell light;
    uint hidden;  // cells, of eight
    uint tests;   // of a blocker against the way to a cell
    uint near;    // blockers that the ways may meet
};

// Half a cell before the surface, or behind it for -0.5. Beyond the border cells hold nothing.
SeenLight seen_light_before(GridPlace grid, LitPlace lit, float cells) {
    const vec3 start = way_start(lit);
    const vec3 between = place_before(grid, lit, cells) - 0.5;
    const ivec3 first = ivec3(floor(between));
    const vec3 share = between - vec3(first);
    const uint macro = macro_cell_before(grid, lit, cells);
    SeenLight seen = SeenLight(LightCell(vec4(0.0), vec4(0.0), vec4(0.0)), 0u, 0u, 0u);
    if (asks_taps != 0u) seen.near = count_near(macro);
    float all = 0.0;
    for (uint i = 0u; i < 8u; ++i) {
        const ivec3 corner = ivec3(i & 1u, i >> 1u & 1u, i >> 2u);
        const vec3 w = mix(1.0 - share, share, vec3(corner));
        const float weight = w.x * w.y * w.z;
        const ivec3 cell = first + corner;
        if (seen.near > 0u && is_stopped_near(macro, start, in_view(middle_of(grid, cell)), seen.tests)) {
            ++seen.hidden;
            continue;
        }
        all += weight;
        if (in_grid(grid, cell)) seen.light = weighted(seen.light, total[cell_index(grid, cell)], weight);
    }
    if (seen.hidden == 0u) return seen;
    const float scale = all < least_share ? 0.0 : 1.0 / all;
    seen.light = LightCell(seen.light.red * scale, seen.light.green * scale, seen.light.blue * scale);
    return seen;
}

SeenLight seen_light(GridPlace grid, LitPlace lit) { return seen_light_before(grid, lit, 0.5); }

#endif
