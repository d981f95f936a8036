// The second target of the original, for bloom and exposure (docs/algorithms/deferred.md 8.1): x / 9 in 8 bits per sample, averaged.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/combine/hi_lo/develop.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2DArray color;
layout(set = 0, binding = 1, rgba32f) writeonly uniform image2D picture;

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(picture)))) return;
    const int samples = textureSize(color, 0).z;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < samples; ++i) sum += nearest_byte(texelFetch(color, ivec3(pixel, i), 0).rgb * view.exposure / hi_scale);
    imageStore(picture, pixel, vec4(nearest_byte(sum / float(samples)), 1.0));
}
