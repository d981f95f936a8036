// The lit share of each pixel's first sample in gray: its shafts relative to those of a ray that is lit throughout.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/luminance.glsl"
#include "passes/sun_shafts/ray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2DArray shafts;
layout(set = 0, binding = 1, rgba32f) writeonly uniform image2D shown;

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(shown)))) return;
    const ShaftRay ray = ray_to(ivec3(pixel, 0));
    const float whole = scattered(ray.meters) * luminance(push.radiance) * phase_factor(ray.direction);
    const float own = luminance(texelFetch(shafts, ivec3(pixel, 0), 0).rgb);
    imageStore(shown, pixel, vec4(vec3(whole > 0.0 ? own / whole : 0.0), 1.0));
}
