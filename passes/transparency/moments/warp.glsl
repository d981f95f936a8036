// Depth on [-1, 1], logarithmic between the nearest and the farthest transparent geometry, and as a phase with a gap for the
// wrapping zone (docs/algorithms/transparency.md 4.2). A shader that includes this declares `MomentsPush push` in its push
// constants first.
#ifndef PASSES_TRANSPARENCY_MOMENTS_WARP_GLSL
#define PASSES_TRANSPARENCY_MOMENTS_WARP_GLSL
#include "passes/transparency/moments/moments.shared.h"
#include "passes/transparency/functions/optical_depth.glsl"

layout(constant_id = 10) const uint kind = moments_power4;

const bool trigonometric = kind >= moments_trig2;
// Of the matrix: one more than there are roots.
const uint order = (trigonometric ? kind - moments_trig2 : kind) + 3u;
const uint roots = order - 1u;
const uint reals = 2u * roots;  // stored besides b0

const float half_turn = 3.14159265358979;
const float wrapping_zone = 0.1 * half_turn;

float warped(float z) { return clamp((log(z) - push.log_nearest) * push.per_log - 1.0, -1.0, 1.0); }

float phase(float w) { return (w + 1.0) * (half_turn - 0.5 * wrapping_zone); }

float moment_depth(vec3 t, uint channel) { return min(channel_depth(t, channel), largest_moment_depth); }

// What a fragment of optical depth 1 adds besides b0: w, w^2, ...; or cos and sin of the phase's multiples.
void fill_moments(float w, out float moments[8]) {
    float power = 1.0;
    for (uint i = 0u; i < 8u; ++i) {
        if (trigonometric) {
            const float angle = float(i / 2u + 1u) * phase(w);
            moments[i] = i % 2u == 0u ? cos(angle) : sin(angle);
        } else {
            power *= w;
            moments[i] = power;
        }
    }
}

#endif
