// What moment-based transparency's C++ and shaders share.
#ifndef PASSES_TRANSPARENCY_MOMENTS_SHARED_H
#define PASSES_TRANSPARENCY_MOMENTS_SHARED_H
#include "passes/transparency/functions/function.shared.h"
#ifdef __cplusplus
namespace strata::transparency {
#endif

const uint moments_power4 = 0u;
const uint moments_power6 = 1u;
const uint moments_power8 = 2u;
const uint moments_trig2 = 3u;
const uint moments_trig3 = 4u;
const uint moments_trig4 = 5u;

// FP32 added; FP16 added; 16 bits of the normalized, transformed moments, written fragment by fragment.
const uint storage_single = 0u;
const uint storage_half = 1u;
const uint storage_normalized = 2u;

const uint compensation_none = 0u;
const uint compensation_own = 1u;

// Push constants of the steps.
struct MomentsPush {
    float log_nearest;  // of the range of depth, in ln meters
    float per_log;      // warped units per ln meter: 2 / ln(farthest / nearest)
    float bias;
    float overestimation;
    uint compensation;
    uint channels;  // 1 or 3
};

struct MomentsCounters {
    FunctionCounters function;
    uint repaired;
};

// Optical depth of one fragment is written up to here: T floor 4.5e-5 (Muenstermann et al. 2018).
const float largest_moment_depth = 10.0f;
// Below it a texel is empty.
const float least_moment_depth = 1e-6f;

#ifdef __cplusplus
}
#endif
#endif
