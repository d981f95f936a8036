// Adds a fragment's optical depth as an integer to one or two slices of its column (docs/algorithms/transparency.md 6.4 and 6.5).
// There is no atomic multiplication, hence logarithms; integers add up to the same in any order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/helper_invocations.glsl"
#include "passes/transparency/fragment.glsl"
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/sources.glsl"
#include "passes/transparency/voxel/volume/voxels.glsl"
#include "passes/transparency/voxel/thick_fragments/segment.glsl"

layout(early_fragment_tests) in;
layout(set = 0, binding = 10, r32ui) uniform uimage2DArray voxels;
layout(set = 0, binding = 20, scalar) buffer Counters { VoxelCounters counters; };

uint saturated(uint word, uint shift, uint code) { return word + (min(code, field_mask - field(word, shift)) << shift); }

// A swap fails where another one has raised a field of the word: two of 16 bits can be raised so often.
const uint most_swaps = 1u << 17u;

void add_saturating(ivec3 at, uint slice, uvec2 codes, bool both) {
    uint seen = imageLoad(voxels, at).r, expected = ~seen;
    for (uint swaps = 0u; swaps < most_swaps && seen != expected; ++swaps) {
        expected = seen;
        uint sum = saturated(seen, shift_of(slice), codes.x);
        if (both) sum = saturated(sum, shift_of(slice + 1u), codes.y);
        seen = imageAtomicCompSwap(voxels, at, expected, sum);
    }
    if (seen != expected) atomicAdd(counters.function.lists.unfinished, 1u);
}

void note_overflow(ivec2 column, uint before, uint slice, uint code) {
    if (code > field_mask - field(before, shift_of(slice))) atomicMin(nearest_overflow[index_of(column)], slice);
}

// codes.x to the slice, and where both are in the word codes.y to the next.
void add_to_word(ivec2 column, uint slice, uvec2 codes, bool both) {
    const ivec3 at = place_of(column, slice);
    atomicAdd(counters.atomics, 1u);
    if (splat == splat_saturating) {
        if (!is_helper()) add_saturating(at, slice, codes, both);
    } else {
        const uint farther = both ? codes.y << shift_of(slice + 1u) : 0u;
        const uint before = imageAtomicAdd(voxels, at, (codes.x << shift_of(slice)) + farther);
        if (splat == splat_overflow_minimum) {
            note_overflow(column, before, slice, codes.x);
            if (both) note_overflow(column, before, slice + 1u, codes.y);
        }
    }
}

// In one word or in two; a loop and not two calls, which lavapipe would inline twice.
void add(ivec2 column, uint slice, uvec2 codes) {
    const bool both = slice % slices_per_word + 1u < slices_per_word;
    if (!both && codes.x > 0u && codes.y > 0u) atomicAdd(counters.border_atomics, 1u);
    for (uint i = 0u; i < 2u; ++i) {
        const uvec2 part = both ? codes * (1u - i) : uvec2(codes[i], 0u);
        if (part.x + part.y > 0u) add_to_word(column, slice + i, part, both);
    }
}

// What fits above each field of a word of three channels.
uint saturated_color(uint word, uvec3 codes) { return word + color_word(min(codes, color_full_code - color_fields(word))); }

void add_color_saturating(ivec3 at, uvec3 codes) {
    uint seen = imageLoad(voxels, at).r, expected = ~seen;
    for (uint swaps = 0u; swaps < most_swaps && seen != expected; ++swaps) {
        expected = seen;
        seen = imageAtomicCompSwap(voxels, at, expected, saturated_color(expected, codes));
    }
    if (seen != expected) atomicAdd(counters.function.lists.unfinished, 1u);
}

// All three channels at once.
void add_color_to_word(ivec2 column, uint slice, uvec3 codes) {
    const ivec3 at = ivec3(column, slice);
    atomicAdd(counters.atomics, 1u);
    if (splat == splat_saturating) {
        if (!is_helper()) add_color_saturating(at, codes);
        return;
    }
    const uvec3 sums = color_fields(imageAtomicAdd(voxels, at, color_word(codes))) + codes;
    for (uint channel = 0u; channel < 3u && splat == splat_overflow_minimum; ++channel)
        if (sums[channel] > color_full_code)
            atomicMin(nearest_overflow[index_of(ivec2(column.x, column.y + (1u + channel) * push.height))], slice);
}

// Integers for a slice and the one behind it. They add up to the code that is not split: rounding both would lose more.
uvec2 split_code(float codes, uint full_code, float share, float r) {
    const float most = min(codes, float(full_code));
    const uint whole = min(uint(most + r), full_code), farther = min(uint(most * share + r), whole);
    return uvec2(whole - farther, farther);
}

// A word each for the slice and the one behind it.
void add_color(ivec2 column, uint slice, uvec2 codes[3]) {
    const uvec3 nearer = uvec3(codes[0].x, codes[1].x, codes[2].x), farther = uvec3(codes[0].y, codes[1].y, codes[2].y);
    if (nearer != uvec3(0u) && farther != uvec3(0u)) atomicAdd(counters.border_atomics, 1u);
    for (uint i = 0u; i < 2u; ++i) {
        const uvec3 part = i == 0u ? nearer : farther;
        if (part != uvec3(0u)) add_color_to_word(column, slice + i, part);
    }
}

// Whether virtual slices, the last included, are in the volume: slices/coverage.glsl says so of every triangle.
bool is_covered(int first, int last) {
    if (sparse == 0u) {
        const int physical = physical_slice(first);
        return physical > physical_slice(first - 1) && physical_slice(last) - physical == last - first;
    }
    for (uint word = uint(first) / slices_per_word; word <= uint(last) / slices_per_word; ++word)
        if (!is_in_pool(uvec2(gl_FragCoord.xy) / tile_size, word)) return false;
    return true;
}

// Two slices at a time: they are most often in one word.
void add_segment(Segment segment, uvec2 texel, Fragment fragment) {
    const vec3 codes = gray_codes(fragment);
    const float r = rounded_up_by(texel);
    const uint first = uint(physical_slice(segment.first));
    for (uint channel = 0u; channel < (packs_colors != 0u ? 1u : push.channels); ++channel) {
        uint behind = code_behind(segment, segment.first, codes[channel], r);
        for (int slice = segment.first; slice <= segment.last; slice += 2) {
            const uint next = min(code_behind(segment, slice + 1, codes[channel], r), behind);
            const uint rest = min(code_behind(segment, slice + 2, codes[channel], r), next);
            add(column_of(texel, channel), first + uint(slice - segment.first), uvec2(behind - next, next - rest));
            behind = rest;
        }
    }
}

void main() {
    const Fragment fragment = transparent_fragment();
    if (!fragment.visible) discard;
    const uvec2 texel = uvec2(gl_FragCoord.xy);
    const Segment segment = segment_at(fragment.z);
    if (segment.meters > 0.0) {
        if (is_covered(segment.first, segment.last)) add_segment(segment, texel, fragment);
        else atomicAdd(counters.uncovered, 1u);
        return;
    }
    const float s = slice_of_depth(fragment.z), r = rounded_up_by(texel);
    const float center = clamp(splatting == splatting_linear ? s - 0.5 : floor(s), 0.0, float(virtual_slices()) - 1.0);
    const bool in_world = interface_layer() == 0u;
    const float share = in_world ? center - floor(center) : 0.0;
    if (in_world && !is_covered(int(center), int(ceil(center)))) {
        atomicAdd(counters.uncovered, 1u);
        return;
    }
    const uint slice = uint(in_world ? physical_slice(int(center)) : slice_of_layer(interface_layer()));
    const bool colored = packs_colors != 0u && source_of(in_draw) == source_color;
    const uint channels = packs_colors != 0u && !colored ? 1u : push.channels, full_code = colored ? color_full_code : push.full_code;
    const float per_depth = colored ? push.color_codes_per_depth : push.codes_per_depth;
    uvec2 codes[3];
    for (uint channel = 0u; channel < channels; ++channel) {
        const float tau = channel_depth(fragment.t, push.channels == 1u ? luminance_channel : channel);
        codes[channel] = split_code(tau * per_depth, full_code, share, r);
        if (!colored) add(column_of(texel, channel), slice, codes[channel]);
    }
    if (colored) add_color(ivec2(texel), slice, codes);
}
