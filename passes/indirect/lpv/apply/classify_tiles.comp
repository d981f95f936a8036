// Tiles of 8 x 8 pixels with a surface, in two lists: those whose taps no blocker is near, and those where one is, which are read by a shader
// that asks (docs/algorithms/lighting.md 3.2, GI_TAP_VIS). The order in a list is that of the atomics: it changes no pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gbuffer/surface_at.glsl"
#include "passes/indirect/lpv/apply/tap_places.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { ApplyPush push; };
layout(set = 0, binding = 1, scalar) buffer Dispatches { TileDispatch dispatches[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Tiles { uint tiles[]; };
layout(set = 0, binding = 6, scalar) buffer Counters { LpvCounters counters; };

shared uint found;  // 1: a surface; 2: a blocker near one

uint what_is_at(ivec3 at) {
    const Surface s = surface_at(at);
    if (!s.exists) return 0u;
    const LitPlace lit = lit_place(s, uvec2(at.xy));
    if (depth_inside(push.grid, lit.place) <= 0.0) return 1u;
    uint near = count_near(list_before(push.grid, lit, reading));
    if (damping > 0.0) near += count_near(list_before(push.grid, lit, -0.5));
    return near > 0u ? 3u : 1u;
}

void append(uint list, uint tile, uint tile_count, uint samples) {
    const uint place = atomicAdd(dispatches[list].count, 1u);
    tiles[list * tile_count + place] = tile;
    atomicMax(dispatches[list].x, min(place + 1u, tile_dispatch_width));
    atomicMax(dispatches[list].y, place / tile_dispatch_width + 1u);
    atomicMax(dispatches[list].z, samples);
    atomicAdd(counters.tiles, 1u);
    atomicAdd(counters.tiles_near_blockers, list);
}

void main() {
    if (gl_LocalInvocationIndex == 0u) found = 0u;
    barrier();
    const ivec3 extent = textureSize(gbuffer0, 0);
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, extent.xy)))
        for (int i = 0; i < extent.z; ++i) atomicOr(found, what_is_at(ivec3(pixel, i)));
    barrier();
    const uvec2 groups = gl_NumWorkGroups.xy;
    if (gl_LocalInvocationIndex == 0u && found > 0u)
        append(found >> 1u, gl_WorkGroupID.y * groups.x + gl_WorkGroupID.x, groups.x * groups.y, uint(extent.z));
}
