// What is in the column under each pixel, as a picture: see the rows of views in voxel.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/views/views.shared.h"
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/volume/tiles.glsl"
#include "passes/transparency/voxel/volume/voxels.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 10) uniform usampler2DArray voxels;
layout(constant_id = 12) const uint shown = view_saturation_depth;
layout(constant_id = 13) const float empty_in_front = 0.0;  // slices between the end of light and where T is 0
layout(constant_id = 14) const uint shown_slice = 0u;
layout(set = 0, binding = 0, rgba32f) uniform writeonly image2DArray picture;

bool holds_numbers(uvec2 texel, uint slice) { return is_used(texel / tile_size, slice / slices_per_word); }

uint integral_at(uvec2 texel, uint channel, uint slice) {
    return integral_code(texelFetch(voxels, integral_place(texel, channel, slice), 0).r, channel, slice);
}

// The nearest slice whose integral of the channel is at least so much; all of them if none is.
uint first_with(uvec2 texel, uint channel, uint code) {
    for (uint slice = 0u; slice < physical_slices(); ++slice)
        if (holds_numbers(texel, slice) && integral_at(texel, channel, slice) >= code) return slice;
    return physical_slices();
}

// Optical depth of so many slices. What is not used holds no numbers: that of the last in front which is.
float depth_up_to(uvec2 texel, uint channel, uint slices) {
    while (slices > 0u && !holds_numbers(texel, slices - 1u)) --slices;
    if (slices == 0u) return 0.0;
    const float per_depth = packs_colors != 0u ? push.color_codes_per_depth : push.codes_per_depth;
    return float(integral_at(texel, channel, slices - 1u)) / per_depth;
}

float used_slices(uvec2 tile) {
    uint words = 0u;
    for (uint block = 0u; block < (push.words + 31u) / 32u; ++block) words += uint(bitCount(used_words(tile, block)));
    return float(words * slices_per_word);
}

float place_of_slice(uint slice) { return float(slice < physical_slices() ? virtual_slice(slice) : virtual_slices()); }

// Depth at which every channel is saturated; 0 where one of them never is.
float saturation_depth(uvec2 texel) {
    uint last = 0u;
    for (uint channel = 0u; channel < push.channels; ++channel) last = max(last, first_with(texel, channel, full_integral()));
    if (last == physical_slices()) return 0.0;
    return depth_of_slice(min(place_of_slice(last) + empty_in_front, float(virtual_slices())));
}

// Of any channel.
float nearest_thickness(uvec2 texel) {
    uint first = physical_slices();
    for (uint channel = 0u; channel < push.channels; ++channel) first = min(first, first_with(texel, channel, 1u));
    return first < physical_slices() ? thickness_at(depth_of_slice(place_of_slice(first) + 0.5)) : 0.0;
}

// Slices from the nearest that overflowed to the last; 0 where none did.
float overflowed_slices(uvec2 texel, uint channel) {
    return float(physical_slices() - min(overflow_of(texel, channel), physical_slices()));
}

float shown_of(uvec2 texel, uint channel) {
    const uint slice = min(shown_slice, physical_slices() - 1u);
    if (shown == view_overflow) return overflowed_slices(texel, channel);
    if (shown == view_occupancy) return used_slices(texel / tile_size);
    if (shown == view_saturation_depth) return saturation_depth(texel);
    if (shown == view_thickness) return nearest_thickness(texel);
    const float up_to = depth_up_to(texel, channel, slice + 1u);
    return shown == view_slice ? up_to - depth_up_to(texel, channel, slice) : up_to;
}

void main() {
    const uvec2 pixel = gl_GlobalInvocationID.xy, extent = uvec2(imageSize(picture).xy);
    if (any(greaterThanEqual(pixel, extent))) return;
    const uvec2 texel = pixel * uvec2(push.width, push.height) / extent;
    vec3 color = vec3(shown_of(texel, 0u));
    if (push.channels > 1u) color.gb = vec2(shown_of(texel, 1u), shown_of(texel, 2u));
    imageStore(picture, ivec3(pixel, 0), vec4(color, 1.0));
}
