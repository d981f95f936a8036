// What the nearest fragment of each pixel reads in front of itself, where nothing is: of itself, and of what is beside it in its column.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/voxel/views/views.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 10) uniform usampler2DArray least_read;
layout(set = 0, binding = 0, rgba32f) uniform writeonly image2DArray picture;

void main() {
    const uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, uvec2(imageSize(picture).xy)))) return;
    const uint bits = texelFetch(least_read, ivec3(pixel, 0), 0).r;
    imageStore(picture, ivec3(pixel, 0), vec4(vec3(bits == reads_nothing ? 0.0 : uintBitsToFloat(bits)), 1.0));
}
