// What a technique of the stage leaves of a sample that it has shaded: radiance within a half float, of a plain pixel for all of
// its samples, whose G-buffer words are equal.
#ifndef PASSES_LIGHTING_STORED_LIGHT_GLSL
#define PASSES_LIGHTING_STORED_LIGHT_GLSL
#include "passes/edges/plain_pixels.glsl"
#include "passes/shaders/largest_half.glsl"

layout(set = 0, binding = 24, rgba16f) writeonly uniform image2DArray light;

// Of a plain pixel `at` is the first sample.
void store_light(ivec3 at, vec3 radiance) {
    const vec4 stored = vec4(clamp(radiance, -largest_half, largest_half), 1.0);
    imageStore(light, at, stored);
    if (!is_plain(at.xy)) return;
    for (int i = 1; i < imageSize(light).z; ++i) imageStore(light, ivec3(at.xy, i), stored);
}

#endif
