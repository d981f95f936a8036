// Where a pixel's slices and taps begin, both from 0 to 1: integers only, so that two runs agree to the bit
// (docs/algorithms/deferred.md 9, H15).
#ifndef PASSES_OCCLUSION_SSAO_NOISE_GLSL
#define PASSES_OCCLUSION_SSAO_NOISE_GLSL
#include "passes/occlusion/ssao/ssao.shared.h"
#include "passes/shaders/scene.glsl"
#include "passes/shaders/hash.shared.h"

layout(constant_id = 4) const uint noise = noise_interleaved;

// x: share of the angle between two slices; y: share of the way between two taps. Interleaved: all sixteen directions and all four
// offsets in every 4 x 4 pixels (Jimenez et al. 2016), the same in every frame.
vec2 noise_at(uvec2 pixel) {
    if (noise == noise_none) return vec2(0.0, 0.5);
    if (noise == noise_hash) {
        const uint drawn = hashed(view.seed, uvec3(pixel, view.frame_index));
        return (vec2(drawn >> 16u, drawn & 0xffffu) + 0.5) / 65536.0;
    }
    const uvec2 p = pixel & 3u;
    return vec2(float((((p.x + p.y) & 3u) << 2u) + p.x) / 16.0, (float((p.y - p.x) & 3u) + 0.5) / 4.0);
}

#endif
