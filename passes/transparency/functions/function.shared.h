// What techniques that are a transmittance function T(z) share: their sums' formats and their counters.
#ifndef PASSES_TRANSPARENCY_FUNCTION_SHARED_H
#define PASSES_TRANSPARENCY_FUNCTION_SHARED_H
#include "passes/transparency/lists/pixel_lists.shared.h"
#ifdef __cplusplus
namespace strata::transparency {
#endif

// Formats of the sums: RGBA16F and R16F; R11G11B10F and R16F; RGBA32F and R32F.
const uint accumulation_half = 0u;
const uint accumulation_packed = 1u;
const uint accumulation_single = 2u;

// What colored layers do where T(z) has one channel: tint the background alone; what is drawn, too; that, but not themselves.
const uint tint_total = 0u;
const uint tint_skew = 1u;
const uint tint_corrected = 2u;

struct FunctionCounters {
    ListCounters lists;  // of techniques that make lists, too
    uint drawn;
    uint scrubbed;
    uint clamped;
};

// Optical depth is written up to here: exp(-32) = 1.3e-14, and a half float can hold 2047 such layers. INF * 0 would be NaN.
const float largest_optical_depth = 32.0f;
// Radiance up to here is weighted and added.
const float largest_radiance = 1e4f;
// A layer's channels differ by a thousand at most where they tint: what takes itself out of that is divided by the least of them.
const float largest_skew_depth = 6.9077553f;
// Below this sum of weights nothing is normalized: emission has none.
const float least_normalizer = 1e-5f;

#ifdef __cplusplus
}
#endif
#endif
