// What a fragment adds (Kircher, GDC 2018; docs/algorithms/transparency.md 3.2), and the mask of tiles that have any.
#ifndef PASSES_TRANSPARENCY_WEIGHTED_ADDITIVE_ACCUMULATION_GLSL
#define PASSES_TRANSPARENCY_WEIGHTED_ADDITIVE_ACCUMULATION_GLSL
#include "passes/transparency/fragment.glsl"
#include "passes/shaders/luminance.glsl"
#include "passes/transparency/weighted_additive/weighted_additive.shared.h"

layout(constant_id = 3) const uint low_resolution = 0u;  // 1: two pixels of the frame per pixel drawn, each way
layout(push_constant, scalar) uniform Push { WeightedAdditiveParams params; };
layout(set = 0, binding = 1, scalar) buffer Counters { WeightedAdditiveCounters counters; };
layout(set = 0, binding = 2, scalar) buffer Written { uint written[]; };  // a bit per tile of the frame, row by row

const float opacity_sensitivity = 3.0, additive_sensitivity = 10.0, additive_layers = 8.0;
const float precision_scalar = 1e4, weight_bias = 5.0, largest_weight = 20.0, nearest = 0.5;
const float largest_color = 1000.0;

// Reading first saves the atomic for all but the first fragments; a stale zero costs one more.
void mark_tile(uvec2 pixel) {
    const uvec2 tile = pixel / tile_edge;
    const uint index = tile.y * ((view.extent.x + tile_edge - 1u) / tile_edge) + tile.x, bit = 1u << (index % 32u);
    if ((written[index / 32u] & bit) == 0u) atomicOr(written[index / 32u], bit);
}

// The pixels of the frame whose bilinear footprint holds this one, at most 4 by 4, lie in at most 2 by 2 tiles.
void mark_tiles() {
    const vec2 pixels = low_resolution != 0u ? vec2(view.extent) / vec2((view.extent + 1u) / 2u) : vec2(1.0);
    const vec2 reach = low_resolution != 0u ? pixels : vec2(0.0);
    const uvec2 low = uvec2(max(gl_FragCoord.xy * pixels - reach, 0.0));
    const uvec2 high = min(uvec2(gl_FragCoord.xy * pixels + reach), view.extent - 1u);
    const uint corners = low_resolution != 0u ? 4u : 1u;
    for (uint i = 0u; i < corners; ++i) mark_tile(uvec2((i & 1u) == 0u ? low.x : high.x, (i & 2u) == 0u ? low.y : high.y));
}

// Colored glass covers less than its alpha (McGuire and Mara 2016).
float coverage_of(Fragment fragment) { return clamp(dot(1.0 - fragment.t, vec3(1.0 / 3.0)), 0.0, 1.0); }

// Emission as the exposed picture shows it.
float relative_emission(Fragment fragment) { return luminance(fragment.e) * view.exposure; }

float weight_of(Fragment fragment) {
    const float emission = clamp(relative_emission(fragment), 0.0, 1.0);
    const float a = clamp(opacity_sensitivity * coverage_of(fragment) + emission / params.feather_start, 0.0, 1.0);
    const float range = params.far - nearest;
    const float b = 1.0 - clamp(params.far / range - params.far * nearest / (fragment.z * range), 0.0, 1.0);
    return min(precision_scalar * b * b * b + weight_bias, largest_weight) * a * a * a;
}

vec4 additiveness_of(Fragment fragment) {
    return vec4(clamp(additive_sensitivity * relative_emission(fragment), 0.0, 1.0) / additive_layers);
}

#endif
