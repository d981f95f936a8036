// The share of decided steps, as views have it.
#version 460

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2DArray decided;
layout(set = 0, binding = 1, rgba32f) writeonly uniform image2D shown;

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(shown)))) return;
    imageStore(shown, pixel, texelFetch(decided, ivec3(pixel, 0), 0));
}
