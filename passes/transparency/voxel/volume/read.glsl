// T(z) = M^-I from the integral of the columns around a fragment, a little in front of it (docs/algorithms/transparency.md 6.7).
// Filtered here and not by a sampler: hardware's weights have 8 bits, which would be 1.1 % of T for each step of the integral. A
// shader that includes this includes fragment.glsl and functions/outputs.glsl and declares `VoxelPush push` in its push constants
// first.
#ifndef PASSES_TRANSPARENCY_VOXEL_READ_GLSL
#define PASSES_TRANSPARENCY_VOXEL_READ_GLSL
#include "passes/transparency/voxel/volume/voxels.glsl"
#include "passes/transparency/voxel/thick_fragments/segment.glsl"

layout(constant_id = 12) const uint sampling = sampling_linear;
layout(constant_id = 13) const uint filters = 1u;  // 0 where columns are pixels
layout(set = 0, binding = 10) uniform usampler2DArray voxels;

// The columns around a pixel's center, two by two, and their weights.
struct Corners {
    ivec2 low, high;
    vec4 weight;
};

Corners corners() {
    const vec2 extent = vec2(push.width, push.height);
    const vec2 place = drawn_place() * extent - (filters != 0u ? 0.5 : 0.0);
    const vec2 first = floor(place), share = place - first, rest = 1.0 - share;
    return Corners(ivec2(max(first, 0.0)), ivec2(min(first + 1.0, extent - 1.0)),
                   vec4(rest.x * rest.y, share.x * rest.y, rest.x * share.y, share.x * share.y));
}

float code_at(ivec2 column, uint slice) {
    return float(field(texelFetch(voxels, place_of(column, slice), 0).r, shift_of(slice)));
}

// Of a word that the tile does not use, the end of the last in front.
vec3 sparse_codes_at(uvec2 texel, uint slice) {
    const uvec2 tile = texel / tile_size;
    const uint word = slice / slices_per_word;
    const int block = last_block(tile, word);
    if (block < 0) return vec3(0.0);
    const uint shift = shift_of(is_in_pool(tile, word) ? slice : slices_per_word - 1u);
    vec3 codes = vec3(field(texelFetch(voxels, place_of_block(texel, 0u, uint(block)), 0).r, shift));
    for (uint channel = 1u; channel < push.channels; ++channel)
        codes[channel] = float(field(texelFetch(voxels, place_of_block(texel, channel, uint(block)), 0).r, shift));
    return codes;
}

// Of the channels that there are, or of one for all of them.
vec3 codes_at(ivec2 texel, uint slice) {
    if (sparse != 0u) return sparse_codes_at(uvec2(texel), slice);
    if (packs_colors != 0u) return vec3(color_fields(texelFetch(voxels, ivec3(texel, slice), 0).r));
    const float first = code_at(texel, slice);
    if (push.channels == 1u) return vec3(first);
    return vec3(first, code_at(column_of(uvec2(texel), 1u), slice), code_at(column_of(uvec2(texel), 2u), slice));
}

// 0 in front of the first slice.
vec3 integral_at(Corners at, int physical) {
    const uint k = uint(max(physical, 0));
    vec3 sum = codes_at(at.low, k);
    if (filters != 0u)
        sum = at.weight.x * sum + at.weight.y * codes_at(ivec2(at.high.x, at.low.y), k) +
              at.weight.z * codes_at(ivec2(at.low.x, at.high.y), k) + at.weight.w * codes_at(at.high, k);
    return physical < 0 ? vec3(0.0) : sum;
}

// Of the values around a place: two, or the four of a cubic B-spline.
vec4 weights(float f) {
    if (sampling == sampling_point) return vec4(1.0, 0.0, 0.0, 0.0);
    if (sampling == sampling_linear) return vec4(1.0 - f, f, 0.0, 0.0);
    const float g = 1.0 - f;
    return vec4(g * g * g, 4.0 - 6.0 * f * f + 3.0 * f * f * f, 4.0 - 6.0 * g * g + 3.0 * g * g * g, f * f * f) / 6.0;
}

const uint values_read = 1u << sampling;

float transmittance(float codes) {
    const float per_depth = packs_colors != 0u ? push.color_codes_per_depth : push.codes_per_depth;
    return codes >= full_share * float(full_integral()) ? 0.0 : exp(-codes / per_depth);
}

vec3 transmittance(vec3 codes) {
    const float red = transmittance(codes.r);
    return push.channels == 1u ? vec3(red) : vec3(red, transmittance(codes.g), transmittance(codes.b));
}

// An integral up to a virtual slice, less what the fragment itself added to it. What is full stays full: who filled it is not known.
vec3 without_own(vec3 sum, Segment segment, int slice, vec3 codes, float r) {
    vec3 own = vec3(0.0);
    for (uint channel = 0u; channel < push.channels; ++channel)
        own[channel] = float(code_behind(segment, segment.first, codes[channel], r) - code_behind(segment, slice + 1, codes[channel], r));
    if (packs_colors != 0u) own *= push.color_codes_per_depth / push.codes_per_depth;
    return mix(max(sum - own, 0.0), sum, greaterThanEqual(sum, vec3(full_share * float(full_integral()))));
}

// Behind the volume what is at its end.
vec3 transmittance_at(Fragment fragment) {
    const float at = slice_of_depth(fragment.z) + push.bias;
    const Segment segment = segment_at(fragment.z);
    const vec3 own = gray_codes(fragment);
    const float r = rounded_up_by(texel_under(uvec2(push.width, push.height)));
    const float center = sampling == sampling_point ? at : at - 0.5, k = floor(center);
    const float first = sampling == sampling_bicubic ? k - 1.0 : k;
    const vec4 weight = weights(center - k);
    const Corners around = corners();
    vec3 codes = vec3(0.0);
    for (uint i = 0u; i < values_read; ++i) {
        const int slice = int(first) + int(i);
        const vec3 sum = integral_at(around, physical_slice(slice));
        codes += weight[i] * (segment.meters > 0.0 ? without_own(sum, segment, slice, own, r) : sum);
    }
    return transmittance(codes);
}

// Not filtered in depth: layers do not share slices.
vec3 transmittance_before(uint layer) { return transmittance(integral_at(corners(), slice_of_layer(layer) - 1)); }

vec3 transmittance_before(Fragment fragment) {
    const uint layer = interface_layer();
    return layer > 0u ? transmittance_before(layer) : transmittance_at(fragment);
}

#endif
