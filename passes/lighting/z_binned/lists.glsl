// The lights of a sample: those that are everywhere, then the bits that its tile and its bin have in common.
#ifndef PASSES_LIGHTING_Z_BINNED_LISTS_GLSL
#define PASSES_LIGHTING_Z_BINNED_LISTS_GLSL
#include "passes/lighting/z_binned/bins.glsl"

layout(set = 0, binding = 8, scalar) readonly buffer Sorted { ZLight sorted[]; };
layout(set = 0, binding = 9, scalar) readonly buffer Header { ZHeader header; };
layout(set = 0, binding = 10, scalar) readonly buffer Bins { uint bins[]; };
layout(set = 0, binding = 11, scalar) readonly buffer Masks { uint masks[]; };
layout(push_constant, scalar) uniform Push { ZBinsPush push; };

struct Span {
    uint low, high;  // of the sorted lights; empty where low > high
    uint first_word; // of its tile in masks
};

Span span_of(ivec2 pixel, float z) {
    const uint range = bins[bin_of(header, push, z)];
    const uvec2 tile = uvec2(pixel) / push.tile_size;
    return Span(range & 0xffffu, range >> 16u, (tile.y * push.tiles_across + tile.x) * push.words);
}

// Lights of the span in one word.
uint lights_in(Span span, uint word) {
    const uint between = bits_between(span.low, span.high, word);
    return between == 0u ? 0u : masks[span.first_word + word] & between;
}

#endif
