// How much of the light between a cell and its next neighbor along an axis the blockers let through: 8 x 8 parallel ways from the plane
// through the one middle to that through the other. A wall as wide as a cell and a half that stops the middle way closes the link but
// for what passes its portals, so that oblique walls do not leak (docs/algorithms/lighting.md 5.6; Kircher, GDC 2018: axial occlusion).
#ifndef PASSES_INDIRECT_LPV_FACE_GLSL
#define PASSES_INDIRECT_LPV_FACE_GLSL
#include "passes/indirect/grid.glsl"
#include "passes/indirect/lpv/lpv.shared.h"
#include "passes/indirect/ways.glsl"

// Bits of the 64 ways.
struct Ways {
    uvec2 stopped, opened;
};

void cross_blocker(uint i, vec3 from, vec3 along, mat2x3 across, inout Ways ways) {
    for (uint way = 0u; way < 64u; ++way) {
        const vec2 place = (vec2(way % 8u, way / 8u) + 0.5) / 8.0 - 0.5;
        const vec3 begin = from + across * place;
        const vec3 at = way_crossing(blockers[i], begin, begin + along);
        if (!inside_blocker(blockers[i], at)) continue;
        const uvec2 bit = way < 32u ? uvec2(1u << way, 0u) : uvec2(0u, 1u << (way - 32u));
        if (passes_portal(i, at)) ways.opened |= bit;
        else ways.stopped |= bit;
    }
}

// Whether any of the ways can meet the blocker: the box around them reaches its plane, and its middle the sphere around it.
bool is_near(BlockerRecord blocker, vec3 middle, float cell) {
    const float reach = 0.8661 * cell;  // half a cell's diagonal
    const float radius = length(vec2(blocker.half_u, blocker.half_v)) + reach;
    const vec3 offset = middle - blocker.center;
    return abs(dot(blocker.normal, offset)) <= reach && dot(offset, offset) <= radius * radius;
}

float bits_of_64(uvec2 bits) { return float(bitCount(bits.x) + bitCount(bits.y)) / 64.0; }

float occlusion(GridPlace grid, ivec3 cell, uint axis) {
    ivec3 next = cell;
    ++next[axis];
    const vec3 from = in_view(middle_of(grid, cell)), to = in_view(middle_of(grid, next));
    vec3 u = vec3(0.0), v = vec3(0.0);
    u[(axis + 1u) % 3u] = grid.cell;
    v[(axis + 2u) % 3u] = grid.cell;
    const mat2x3 across = mat2x3(in_view(u), in_view(v));
    Ways ways = Ways(uvec2(0u), uvec2(0u));
    bool closed = false;
    for (uint i = 0u; i < blocker_count; ++i) {
        if (!is_near(blockers[i], 0.5 * (from + to), grid.cell)) continue;
        cross_blocker(i, from, to - from, across, ways);
        if (2.0 * min(blockers[i].half_u, blockers[i].half_v) < 1.5 * grid.cell) continue;
        const vec3 at = way_crossing(blockers[i], from, to);
        closed = closed || inside_blocker(blockers[i], at) && !passes_portal(i, at);
    }
    const float area = bits_of_64(ways.stopped);
    return closed ? max(area, 1.0 - bits_of_64(ways.opened & ~ways.stopped)) : area;
}

// In steps of 1 / 255. The neighbor is in the grid.
float link(GridPlace grid, ivec3 cell, uint axis) {
    const float occluded = occlusion(grid, cell, axis);
    return 1.0 - (occluded >= 0.999 ? 1.0 : roundEven(occluded * 255.0) / 255.0);
}

#endif
