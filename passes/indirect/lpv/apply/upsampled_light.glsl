// What a pixel takes of the light of the four blocks of 2 x 2 pixels around it.
#ifndef PASSES_INDIRECT_LPV_UPSAMPLED_LIGHT_GLSL
#define PASSES_INDIRECT_LPV_UPSAMPLED_LIGHT_GLSL
#include "passes/indirect/lpv/apply/half_resolution.glsl"

layout(set = 0, binding = 9) uniform sampler2D block_light;  // a: 1 where the grid lights the block's pixel

// The least sum of weights that stands for a pixel.
const float least_fit = 0.25;

// How well another surface stands for this one: less with pixels between them, with distance, which ends at half a cell, as light changes
// from cell to cell, and with the angle between normals, which ends at 60 degrees.
float fit(GridPlace grid, LitPlace lit, LitPlace other, vec2 pixels) {
    const vec2 tent = max(vec2(0.0), 1.0 - abs(pixels) / 3.0);
    const float nearness = max(0.0, 1.0 - 2.0 * distance(lit.place, other.place) / grid.cell);
    return tent.x * tent.y * nearness * max(0.0, 2.0 * dot(lit.normal, other.normal) - 1.0);
}

// Both ends are within reach of the macro-cell of this surface (macro_cells.comp): they are at most half a cell apart.
bool are_parted(GridPlace grid, LitPlace lit, LitPlace other) {
    if (asks_taps == 0u) return false;
    const uint list = list_before(grid, lit, reading);
    if (count_near(list) == 0u) return false;
    uint tests = 0u;
    const bool stopped = is_stopped_near(list, way_start(lit), way_start(other), tests);
    atomicAdd(counters.blocker_tests, tests);
    return stopped;
}

// Light times weight, and the weight. Nothing comes from behind a blocker.
vec4 upsampled_light(GridPlace grid, LitPlace lit, ivec2 pixel) {
    const ivec2 aside = 2 * (pixel & 1) - 1;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        const ivec2 block = pixel / 2 + aside * ivec2(i & 1, i >> 1);
        if (any(lessThan(block, ivec2(0))) || any(greaterThanEqual(block, textureSize(block_light, 0)))) continue;
        const vec4 light = texelFetch(block_light, block, 0);
        if (light.a == 0.0) continue;
        const ivec2 chosen = pixel_of(block, texelFetch(chosen_pixels, block, 0).r);
        const LitPlace other = lit_pixel(chosen);
        const float weight = fit(grid, lit, other, vec2(pixel - chosen));
        if (weight > 0.0 && !are_parted(grid, lit, other)) sum += weight * vec4(light.rgb, 1.0);
    }
    return sum;
}

#endif
