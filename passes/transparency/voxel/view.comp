// What is in the column under each pixel, as a picture: see the rows of views in voxel.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/voxels.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 10) uniform usampler2DArray voxels;
layout(constant_id = 12) const uint shown = view_zero_depth;
layout(constant_id = 13) const float empty_in_front = 0.0;  // slices between the end of light and where T is 0
layout(set = 0, binding = 0, rgba32f) uniform writeonly image2DArray picture;

// The nearest slice whose integral is at least so much; all of them if none is.
uint first_with(ivec2 column, uint code) {
    uint slice = 0u;
    for (; slice < push.slices; ++slice)
        if (field(texelFetch(voxels, place_of(column, slice), 0).r, shift_of(slice)) >= code) break;
    return slice;
}

float shown_of(ivec2 column) {
    if (shown == view_overflow) return splat == splat_overflow_minimum ? float(min(nearest_overflow[index_of(column)], push.slices)) : float(push.slices);
    const uint slice = first_with(column, shown == view_zero_depth ? push.full_code : 1u);
    if (shown == view_zero_depth) return depth_of_slice(min(float(slice) + empty_in_front, float(push.slices)));
    return slice < push.slices ? thickness_at(depth_of_slice(float(slice) + 0.5)) : 0.0;
}

void main() {
    const uvec2 pixel = gl_GlobalInvocationID.xy, extent = uvec2(imageSize(picture).xy);
    if (any(greaterThanEqual(pixel, extent))) return;
    const uvec2 texel = pixel * uvec2(push.width, push.height) / extent;
    imageStore(picture, ivec3(pixel, 0), vec4(vec3(shown_of(column_of(texel, 0u))), 1.0));
}
