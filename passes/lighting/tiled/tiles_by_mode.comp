// Tiles by their mode, in the order of the screen, and the dispatches that shade them: a counting sort in one group. Places come
// from bits per mode and not from atomics, so the list is the same on every run (an append by atomics,
// docs/algorithms/lighting.md 3.3, is not; a list per mode would take as many times the memory).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lighting/tiled/tiled.shared.h"

layout(local_size_x = 256) in;
layout(constant_id = 0) const uint tile_count = 0u;
layout(set = 0, binding = 0, scalar) readonly buffer Records { TileRecord records[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Dispatches { ModeDispatch dispatches[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Tiles { uint tiles[]; };
layout(set = 0, binding = 3, scalar) buffer Counters { TiledCounters counters; };
layout(push_constant, scalar) uniform Push { uint modes_compiled; };

const uint words = tile_threads / 32u;

shared uint tiles_of[most_modes];
shared uint next_place[most_modes];
shared uint bits[most_modes * words];

uint mode_of(uint tile) { return tile < tile_count ? records[tile].counts >> 16 & 255u : empty_tile_mode; }

void count_tiles() {
    if (gl_LocalInvocationIndex < most_modes) tiles_of[gl_LocalInvocationIndex] = 0u;
    barrier();
    for (uint tile = gl_LocalInvocationIndex; tile < tile_count; tile += tile_threads) {
        const uint mode = mode_of(tile);
        if (mode != empty_tile_mode) atomicAdd(tiles_of[mode], 1u);
    }
    barrier();
}

void write_dispatches() {
    const uint mode = gl_LocalInvocationIndex;
    if (mode == 0u) counters.modes_compiled = modes_compiled;
    if (mode < most_modes) {
        uint first = 0u;
        for (uint i = 0u; i < mode; ++i) first += tiles_of[i];
        const uint count = tiles_of[mode], rows = (count + dispatch_width - 1u) / dispatch_width;
        dispatches[mode] = ModeDispatch(min(count, dispatch_width), rows, 1u, first, count);
        next_place[mode] = first;
        if (count > 0u) atomicAdd(counters.modes_used, 1u);
    }
    barrier();
}

// 256 tiles at a time.
void place_tiles(uint first) {
    const uint thread = gl_LocalInvocationIndex, mode = mode_of(first + thread);
    if (thread < most_modes * words) bits[thread] = 0u;
    barrier();
    if (mode != empty_tile_mode) atomicOr(bits[mode * words + thread / 32u], 1u << (thread & 31u));
    barrier();
    if (mode != empty_tile_mode) {
        uint place = next_place[mode] + uint(bitCount(bits[mode * words + thread / 32u] & ((1u << (thread & 31u)) - 1u)));
        for (uint i = 0u; i < thread / 32u; ++i) place += uint(bitCount(bits[mode * words + i]));
        tiles[place] = first + thread;
    }
    barrier();
    for (uint i = 0u; thread < most_modes && i < words; ++i) next_place[thread] += uint(bitCount(bits[thread * words + i]));
    barrier();
}

void main() {
    count_tiles();
    write_dispatches();
    for (uint first = 0u; first < tile_count; first += tile_threads) place_tiles(first);
}
