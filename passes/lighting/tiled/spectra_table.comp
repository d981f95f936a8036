// Rows of the table of spectra: spectrum, its tiles, its mode, what that has too much; most tiles first, then the smaller
// spectrum. A thread per spectrum finds its rank by looking at all, four at a time: lavapipe 22.3 ends an invocation's loops,
// all together, after 65535 iterations.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lighting/tiled/modes.glsl"
#include "passes/lighting/tiled/tiled.shared.h"
#include "passes/shaders/light_features.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Histogram { uvec4 histogram[]; };
layout(set = 0, binding = 1, rgba32f) uniform image2DArray numbers;
layout(push_constant, scalar) uniform Push { ModeOrder order; };

// As tile_header.glsl chooses a mode: light volumes are not its to read.
vec4 row_of(uint spectrum, uint tiles) {
    const uint shaded = spectrum & ~feature_gi_tap_visibility;
    uint place = 0u;
    while (place + 1u < order.count && !serves(order.modes[place], shaded)) ++place;
    const uint mode = order.modes[place];
    return vec4(spectrum, tiles, mode >> 16, mode & every_light_feature & ~spectrum);
}

int rank_of(uint spectrum, uint tiles) {
    int rank = 0;
    for (uint four = 0u; four <= every_light_feature / 4u; ++four) {
        const uvec4 others = histogram[four];
        const uvec4 more = uvec4(greaterThan(others, uvec4(tiles))), same = uvec4(equal(others, uvec4(tiles)));
        const uvec4 smaller = uvec4(lessThan(4u * four + uvec4(0u, 1u, 2u, 3u), uvec4(spectrum)));
        const uvec4 before = more | same & smaller;
        rank += int(before.x + before.y + before.z + before.w);
    }
    return rank;
}

void main() {
    const uint spectrum = gl_GlobalInvocationID.x;
    const uint tiles = spectrum <= every_light_feature ? histogram[spectrum / 4u][spectrum & 3u] : 0u;
    if (tiles == 0u) return;
    const int rank = rank_of(spectrum, tiles);
    if (rank < imageSize(numbers).y) imageStore(numbers, ivec3(0, rank, 0), row_of(spectrum, tiles));
}
