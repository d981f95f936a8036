// Develops the picture (docs/algorithms/deferred.md 8.1, 3.5): every sample is exposed and tone mapped, then the samples are
// averaged. The other order would let one sample of 100 outweigh three of 0.1.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/scene.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2DArray color;
layout(set = 0, binding = 1, rgba16f) writeonly uniform image2D display;

// x (1 + x / white^2) / (1 + x) grows everywhere and is 1 at white: clamping before it is clamping after it, without overflow.
vec3 tone_mapped(vec3 exposed) {
    const vec3 x = clamp(exposed, 0.0, view.white);
    return x * (1.0 + x / (view.white * view.white)) / (1.0 + x);
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(display)))) return;
    const int samples = textureSize(color, 0).z;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < samples; ++i) sum += tone_mapped(texelFetch(color, ivec3(pixel, i), 0).rgb * view.exposure);
    imageStore(display, pixel, vec4(sum / float(samples), 1.0));
}
