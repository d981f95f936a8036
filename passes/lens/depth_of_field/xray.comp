// X-Ray's depth of field (docs/algorithms/deferred.md 8.7): twelve taps of a Poisson disc that is as wide as the pixel's own blur, each
// weighing as much as its own.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lens/depth_of_field/xray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 1, rgba32f) writeonly uniform image2DArray blurred;

vec3 seen(ivec3 at) {
    const vec3 own = texelFetch(color, at, 0).rgb;
    const float factor = factor_at(at);
    if (factor == 0.0) return own;
    const vec2 radius = xray_radius(factor);
    vec4 sum = is_number(own) ? vec4(own, 1.0) : vec4(0.0);
    for (int i = 0; i < 12; ++i) {
        const vec2 place = vec2(at.xy) + 0.5 + xray_taps[i] * radius;
        sum += factor_at(tapped_sample(place, at.z)) * vec4(mixed(place, at.z), 1.0);
    }
    return sum.a > 0.0 ? sum.rgb / sum.a : own;
}

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(blurred)))) return;
    imageStore(blurred, at, vec4(seen(at), texelFetch(color, at, 0).a));
}
