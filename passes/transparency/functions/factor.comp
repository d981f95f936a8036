// The factor of the resolve as a picture: of the first sample and channel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/functions/sums.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, rgba32f) uniform writeonly image2DArray picture;

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(picture)))) return;
    const float found = factor_at(at, extinction_at(at)).r;
    imageStore(picture, at, vec4(vec3(found), 1.0));
}
