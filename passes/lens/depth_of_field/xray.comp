// X-Ray's depth of field (docs/algorithms/deferred.md 8.7): twelve taps of a Poisson disc that is as wide as the pixel's own blur, each
// weighing as much as its own.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lens/depth_of_field/blur.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 1, rgba32f) writeonly uniform image2DArray blurred;

const vec2 taps[12] = vec2[12](vec2(-0.326212, -0.405810), vec2(-0.840144, -0.073580), vec2(-0.695914, 0.457137),
                               vec2(-0.203345, 0.620716), vec2(0.962340, -0.194983), vec2(0.473434, -0.480026),
                               vec2(0.519456, 0.767022), vec2(0.185461, -0.893124), vec2(0.507431, 0.064425),
                               vec2(0.896420, 0.412458), vec2(-0.321940, -0.932615), vec2(-0.791559, -0.597710));

// b(z): 0 in focus, 1 at xray_far.
float factor_at(ivec3 at) {
    const float d = depth_at(at), z = d > 0.0 ? view.near / d : xray_sky;
    const float beyond = clamp((z - push.focus) / (xray_far - push.focus), 0.0, 1.0);
    const float before = clamp((z - push.focus) / (xray_near - push.focus), 0.0, 1.0);
    return (beyond + before) * (beyond + before);
}

vec3 seen(ivec3 at) {
    const vec3 own = texelFetch(color, at, 0).rgb;
    const float factor = factor_at(at);
    if (factor == 0.0) return own;
    const ivec2 size = textureSize(color, 0).xy;
    const vec2 radius = factor * vec2(xray_radius_u, xray_radius_v) * vec2(size);
    vec4 sum = is_number(own) ? vec4(own, 1.0) : vec4(0.0);
    for (int i = 0; i < 12; ++i) {
        const vec2 place = vec2(at.xy) + 0.5 + taps[i] * radius;
        const float weight = factor_at(ivec3(clamp(ivec2(floor(place)), ivec2(0), size - 1), at.z));
        sum += weight * vec4(mixed(place, at.z), 1.0);
    }
    return sum.a > 0.0 ? sum.rgb / sum.a : own;
}

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(blurred)))) return;
    imageStore(blurred, at, vec4(seen(at), texelFetch(color, at, 0).a));
}
