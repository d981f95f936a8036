// The prefilter: lights that reach a macro tile of 128 x 128 pixels at any depth, in index order, as candidates for its 64 tiles
// (docs/algorithms/lighting.md 1.5 A). Without it every tile asks every light.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/lighting/tile_cell.glsl"
#include "passes/lighting/tiled/tiled.shared.h"

layout(local_size_x = 256) in;
layout(set = 0, binding = 0, scalar) writeonly buffer Candidates { uint candidates[]; };

#include "passes/lighting/tiled/ordered_append.glsl"

// Each macro tile has a word for the number and as many as there are lights to list.
uint listed_lights() { return min(view.light_count, most_listed); }

void main() {
    const uvec2 tile = gl_WorkGroupID.xy;
    const uint first = (tile.y * gl_NumWorkGroups.x + tile.x) * (listed_lights() + 1u);
    const Cell cell = tile_cell(tile, macro_size, 0.0, farthest_cell);
    uint found = 0u;
    for (uint base = 0u; base < listed_lights(); base += tile_threads) {
        const uint index = base + gl_LocalInvocationIndex;
        const bool touches = index < listed_lights() && light_touches(lights[min(index, view.light_count - 1u)], cell);
        const uvec2 place = place_in_group(touches);
        if (touches) candidates[first + 1u + found + place.x] = index;
        found += place.y;
    }
    if (gl_LocalInvocationIndex == 0u) candidates[first] = found;
}
