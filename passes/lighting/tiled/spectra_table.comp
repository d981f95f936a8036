// Rows of the table of spectra: spectrum, its tiles, its mode, what that has too much; most tiles first, then the smaller
// spectrum. One group: every thread finds the rank of its spectra by looking at all.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lighting/tiled/tiled.shared.h"
#include "passes/shaders/light_features.shared.h"

layout(local_size_x = 256) in;
layout(set = 0, binding = 0, scalar) readonly buffer Histogram { uint histogram[]; };
layout(set = 0, binding = 1, rgba32f) uniform writeonly coherent image2DArray numbers;
layout(push_constant, scalar) uniform Push { ModeOrder order; };

bool serves(uint mode, uint spectrum) { return (spectrum & ~mode & every_light_feature) == 0u; }

vec4 row_of(uint spectrum) {
    uint place = 0u;
    while (place + 1u < order.count && !serves(order.modes[place], spectrum)) ++place;
    const uint mode = order.modes[place];
    return vec4(spectrum, histogram[spectrum], mode >> 16, mode & every_light_feature & ~spectrum);
}

int rank_of(uint spectrum) {
    const uint tiles = histogram[spectrum];
    int rank = 0;
    for (uint other = 0u; other <= every_light_feature; ++other)
        rank += int(histogram[other] > tiles || histogram[other] == tiles && other < spectrum);
    return rank;
}

void main() {
    const int rows = imageSize(numbers).y;
    for (int row = int(gl_LocalInvocationIndex); row < rows; row += int(tile_threads))
        imageStore(numbers, ivec3(0, row, 0), vec4(uintBitsToFloat(0x7fc00000u)));
    memoryBarrierImage();
    barrier();
    for (uint spectrum = gl_LocalInvocationIndex; spectrum <= every_light_feature; spectrum += tile_threads) {
        if (histogram[spectrum] == 0u) continue;
        const int rank = rank_of(spectrum);
        if (rank < rows) imageStore(numbers, ivec3(0, rank, 0), row_of(spectrum));
    }
}
