// Motion of what is seen, the first sample's: (sum (1 - t) T(z) v) (1 - T_total) / N + v_behind T_total
// (docs/algorithms/transparency.md 6.13), of luminances where there are three channels. w: T_total.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/functions/sums.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, rgba32f) uniform writeonly image2DArray picture;
layout(set = 0, binding = 11) uniform sampler2DArray motion_behind;

// Of the weights that the motions were added up with.
float weight_at(ivec3 at) {
    const vec4 weights = merged(normalizer, low_normalizer, at);
    return tint != tint_total ? weights.x : luminance(channels(weights));
}

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(picture)))) return;
    const float n = weight_at(at), through = luminance(exp(-extinction_at(at)));
    vec2 moved = texelFetch(motion_behind, at, 0).rg * through;
    if (n > least_normalizer) moved += merged(offset, low_offset, at).rg * (1.0 - through) / n;
    imageStore(picture, at, vec4(moved, 0.0, through));
}
