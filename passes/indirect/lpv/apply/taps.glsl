// What a surface sees of the cells around a place half a cell before it, without those that a blocker hides from it
// (docs/algorithms/lighting.md 5.8).
#ifndef PASSES_INDIRECT_LPV_TAPS_GLSL
#define PASSES_INDIRECT_LPV_TAPS_GLSL
#include "passes/gbuffer/surface.glsl"
#include "passes/indirect/lpv/grid.glsl"
#include "passes/indirect/lpv/occlusion/ways.glsl"

layout(constant_id = 3) const uint asks_taps = 0u;  // 1: not of cells that a blocker hides

layout(set = 0, binding = 0, scalar) readonly buffer Total { LightCell total[]; };

// Metres off the surface from which taps are asked about, and the least share of taps that stands for all.
const float tap_start = 0.02;
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

struct SeenLight {
    LightCell light;
    uint hidden;  // cells, of eight
};

// Beyond the border cells hold nothing.
SeenLight seen_light(GridPlace grid, LitPlace lit) {
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
        if (asks_taps != 0u && is_stopped(start, in_view(middle_of(grid, cell)))) {
            ++hidden;
            continue;
        }
        all += weight;
        if (in_grid(grid, cell)) sum = weighted(sum, total[cell_index(grid, cell)], weight);
    }
    if (hidden == 0u) return SeenLight(sum, 0u);
    const float scale = all < least_share ? 0.0 : 1.0 / all;
    return SeenLight(LightCell(sum.red * scale, sum.green * scale, sum.blue * scale), hidden);
}

#endif
