// The depth of each pixel's tile in meters.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/camera.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 10) const uint tile_edge = 16u;
layout(set = 0, binding = 10) uniform sampler2DArray zero_depth;
layout(set = 0, binding = 0, rgba32f) uniform writeonly image2DArray picture;

void main() {
    const uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, uvec2(imageSize(picture).xy)))) return;
    const float depth = texelFetch(zero_depth, ivec3(pixel / tile_edge, 0), 0).r;
    imageStore(picture, ivec3(pixel, 0), vec4(vec3(depth > 0.0 ? view_z(depth) : 0.0), 1.0));
}
