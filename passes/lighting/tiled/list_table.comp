// Rows of the tables of lists: tile, light, and the light's blockers or portals that the tile's pixels test, 16 bits each. A tile
// has as many rows as fit an image; what it does not use is no row. Rows go along x: of a group narrower than its vectors of
// eight lavapipe 22.3 runs the missing lanes, too, which read zeros and walk records until it ends their loop after 65535 iterations.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lighting/tiled/tiled.shared.h"
#include "passes/lighting/tiled/views.shared.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint shown = list_blockers;
layout(constant_id = 1) const uint rows_per_tile = 1u;
layout(set = 0, binding = 0, scalar) readonly buffer Records { TileRecord records[]; };
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2DArray numbers;

vec4 row_of(uint tile, uint place) {
    const vec4 none = vec4(uintBitsToFloat(0x7fc00000u));
    if ((records[tile].counts >> 16 & 255u) == empty_tile_mode) return none;
    uint record = tile, before = 0u;
    for (; (record & next_is_light) == 0u; record = records[record].next) {
        const uint count = records[record].counts & 255u, i = place - before;
        if (i < count) {
            const uint light = records[record].lights[i / 2u] >> (16u * (i & 1u)) & 0xffffu;
            const uint mask = shown == list_blockers ? records[record].blockers[i] : records[record].portals[i];
            return vec4(tile, light, mask & 0xffffu, mask >> 16);
        }
        before += count;
    }
    return none;
}

void main() {
    const uint row = gl_GlobalInvocationID.x;
    if (row >= uint(imageSize(numbers).y)) return;
    imageStore(numbers, ivec3(0, row, 0), row_of(row / rows_per_tile, row % rows_per_tile));
}
