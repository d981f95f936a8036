// What is in the column under each pixel, as a picture: see the rows of views in voxel.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/tiles.glsl"
#include "passes/transparency/voxel/voxels.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 10) uniform usampler2DArray voxels;
layout(constant_id = 12) const uint shown = view_saturation_depth;
layout(constant_id = 13) const float empty_in_front = 0.0;  // slices between the end of light and where T is 0
layout(set = 0, binding = 0, rgba32f) uniform writeonly image2DArray picture;

// The nearest slice whose integral of the first channel is at least so much; all of them if none is.
uint first_with(uvec2 texel, uint code) {
    for (uint slice = 0u; slice < physical_slices(); ++slice) {
        if (!is_used(texel / tile_size, slice / slices_per_word)) continue;
        if (integral_code(texelFetch(voxels, integral_place(texel, 0u, slice), 0).r, 0u, slice) >= code) return slice;
    }
    return physical_slices();
}

float used_slices(uvec2 tile) {
    uint words = 0u;
    for (uint block = 0u; block < (push.words + 31u) / 32u; ++block) words += uint(bitCount(used_words(tile, block)));
    return float(words * slices_per_word);
}

float shown_of(uvec2 texel) {
    if (shown == view_overflow) return float(min(overflow_of(texel, 0u), physical_slices()));
    if (shown == view_occupancy) return used_slices(texel / tile_size);
    const uint slice = first_with(texel, shown == view_saturation_depth ? full_integral() : 1u);
    const float place = slice < physical_slices() ? float(virtual_slice(slice)) : float(virtual_slices());
    if (shown == view_saturation_depth) return depth_of_slice(min(place + empty_in_front, float(virtual_slices())));
    return slice < physical_slices() ? thickness_at(depth_of_slice(place + 0.5)) : 0.0;
}

void main() {
    const uvec2 pixel = gl_GlobalInvocationID.xy, extent = uvec2(imageSize(picture).xy);
    if (any(greaterThanEqual(pixel, extent))) return;
    const uvec2 texel = pixel * uvec2(push.width, push.height) / extent;
    imageStore(picture, ivec3(pixel, 0), vec4(vec3(shown_of(texel)), 1.0));
}
