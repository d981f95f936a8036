// Luminance of a tile of pixels, summed in a fixed order (docs/algorithms/deferred.md 8.5, H15). Samples that are no numbers do not
// count.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lens/samples.glsl"
#include "passes/shaders/luminance.glsl"
#include "passes/shaders/scene.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

layout(constant_id = 1) const uint form = exposure_exponential;

layout(set = 0, binding = 1, scalar) writeonly buffer Tiles { MeterRecord tiles[]; };
layout(set = 0, binding = 2) uniform sampler2D held;

shared vec2 sums[meter_threads];

// X-Ray measures the picture as the exposure of the frame before shows it, clipped as its target Hi is; its weights sum to .9.
float measured(vec3 c) {
    const vec3 exposed = bounded(c * view.exposure);
    if (form == exposure_exponential) return luminance(exposed);
    const vec4 before = texelFetch(held, ivec2(0), 0);
    const vec3 hi = min(exposed * (before.y > 0.0 ? before.x : 1.0) / hi_end, 1.0);
    return dot(hi, vec3(0.3, 0.38, 0.22)) * hi_end;
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    const ivec3 size = textureSize(color, 0);
    vec2 sum = vec2(0.0);
    if (all(lessThan(pixel, size.xy)))
        for (int i = 0; i < size.z; ++i) {
            const vec3 c = texelFetch(color, ivec3(pixel, i), 0).rgb;
            if (!any(isnan(c))) sum += vec2(measured(c), 1.0);
        }
    const uint i = gl_LocalInvocationIndex;
    sums[i] = sum;
    for (uint half_of = meter_threads / 2u; half_of > 0u; half_of /= 2u) {
        barrier();
        if (i < half_of) sums[i] += sums[i + half_of];
    }
    if (i == 0u) tiles[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x] = MeterRecord(sums[0].x, sums[0].y);
}
