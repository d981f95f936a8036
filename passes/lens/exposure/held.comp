// What earlier frames left of the exposure (docs/algorithms/deferred.md 8.5): x is the exposure held, y the seconds since, z X-Ray's
// share of the way. y is 0 where a frame starts anew: the first one, one that is replayed again, one that lies back in time.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lens/lens.shared.h"

layout(local_size_x = 1) in;

layout(set = 0, binding = 0, rgba32f) writeonly uniform image2D held;
layout(set = 0, binding = 1, scalar) readonly buffer State { ExposureState state; };
layout(push_constant, scalar) uniform Push { HeldPush push; };

// Seconds from the state's time on, 4096 at most; 0 where it is none later.
float seconds_since() {
    uint borrow;
    const uint low = usubBorrow(push.ticks.x, state.ticks.x, borrow);
    const uint high = push.ticks.y - state.ticks.y - borrow;
    if (high >= 0x80000000u) return 0.0;
    return high == 0u ? float(low) / ticks_per_second : 4096.0;
}

void main() {
    const float seconds = seconds_since();
    const bool goes_on = state.is_set == 1u && seconds > 0.0;
    imageStore(held, ivec2(0), goes_on ? vec4(state.exposure, seconds, state.share, 0.0) : vec4(0.0));
}
