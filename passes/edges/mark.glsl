// What shaders that mark edges have in common: the image they store to and what they count. passes/edges/mark.h declares their
// step. A shader defines main().
#ifndef PASSES_EDGES_MARK_GLSL
#define PASSES_EDGES_MARK_GLSL
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "passes/edges/edges.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, r8ui) writeonly uniform uimage2D edges;
layout(set = 0, binding = 1, scalar) buffer Counters { EdgeCounters counters; };
layout(set = 0, binding = 2) uniform sampler2DArray emission;  // a is 1 on a surface

bool is_outside(ivec2 pixel) { return any(greaterThanEqual(pixel, imageSize(edges))); }

int sample_count() { return textureSize(emission, 0).z; }

// Samples with a surface. Where it is neither 0 nor sample_count(), the pixel is an edge by every technique.
uint covered_samples(ivec2 pixel) {
    uint covered = 0u;
    for (int i = 0; i < sample_count(); ++i) covered += texelFetch(emission, ivec3(pixel, i), 0).a > 0.0 ? 1u : 0u;
    return covered;
}

bool is_partly_covered(uint covered) { return covered != 0u && covered != uint(sample_count()); }

// Stores the pixel's mark and counts it (docs/algorithms/deferred.md 3.4).
void mark(ivec2 pixel, bool is_edge, uint covered) {
    imageStore(edges, pixel, uvec4(is_edge ? 1u : 0u));
    const bool is_sky = !is_edge && covered == 0u;
    const uvec4 here = uvec4(!is_edge && !is_sky ? 1u : 0u, is_edge ? 1u : 0u, is_sky ? 1u : 0u, is_edge ? covered : 0u);
    const uvec4 all = subgroupAdd(here);
    if (!subgroupElect()) return;
    atomicAdd(counters.plain_pixels, all.x);
    atomicAdd(counters.edge_pixels, all.y);
    atomicAdd(counters.sky_pixels, all.z);
    atomicAdd(counters.edge_samples, all.w);
}

#endif
