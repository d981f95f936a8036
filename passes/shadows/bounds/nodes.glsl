// Asks bounds of shadow maps about many neighboring lookups at once: their blocks are covered by at most 2 x 2 nodes of the finest
// level that has such (docs/algorithms/deferred.md 6.3). passes/shadows/bounds/nodes.h builds the nodes and fixes the constant. Include it
// after query.glsl.
#ifndef PASSES_SHADOWS_BOUNDS_NODES_GLSL
#define PASSES_SHADOWS_BOUNDS_NODES_GLSL

layout(constant_id = 110) const int bounds_levels = 0;  // above the bounds themselves, which are level 0

layout(set = 0, binding = 34) uniform sampler2DArray bounds_nodes;

// The finest level at which 2 x 2 nodes hold the blocks from `first` to `last`, both inside; bounds_levels + 1: there is none.
int level_around(ivec2 first, ivec2 last) {
    int level = 0;
    while (level <= bounds_levels && any(greaterThan((last >> level) - (first >> level), ivec2(1)))) ++level;
    return level;
}

// Form extremes: of the blocks of a node.
vec2 extremes_of_blocks(ivec3 corner, int level, ivec2 node) {
    if (level == 0) return bounds_texel(corner, node).xy;
    const int width = 2 * textureSize(bounds_nodes, 0).y;
    const ivec2 origin = ivec2(width - (width >> (level - 1)), 0);
    return texelFetch(bounds_nodes, ivec3(origin + (corner.xy / bounds_block >> level) + node, corner.z), 0).xy;
}

#endif
