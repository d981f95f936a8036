// What a surface sees of the cells around a place half a cell before it, without those that a blocker hides from it
// (docs/algorithms/lighting.md 5.8).
#ifndef PASSES_INDIRECT_LPV_TAPS_GLSL
#define PASSES_INDIRECT_LPV_TAPS_GLSL
#include "passes/indirect/lpv/apply/tap_places.glsl"

layout(constant_id = 3) const uint asks_taps = 0u;  // 1: not of cells that a blocker hides

layout(set = 0, binding = 0, scalar) readonly buffer Total { LightCell total[]; };

// The least share of taps that stands for all.
const float least_share = 0.02;
LightCell weighted(LightCell sum, LightCell light, float weight) {
    return LightCell(sum.red + weight * light.red, sum.green + weight * light.green, sum.blue + weight * light.blue);
}

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
