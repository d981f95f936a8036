// What weighted blending with additiveness shares between C++ and GLSL.
#ifndef PASSES_TRANSPARENCY_WEIGHTED_ADDITIVE_SHARED_H
#define PASSES_TRANSPARENCY_WEIGHTED_ADDITIVE_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::transparency {
#endif

// What `reveal` and `additiveness` are stored in: unorm bytes as published, or half floats.
const uint reveal_r8 = 0u;
const uint reveal_r16f = 1u;

// Published: one average of everything over the sum of weights. Corrected: what covers is averaged over the sum of alpha w,
// and what emits on its own.
const uint normalization_published = 0u;
const uint normalization_corrected = 1u;

// Which tiles the composite works on.
const uint tiles_written = 0u;
const uint tiles_all = 1u;

struct WeightedAdditiveParams {
    float far;            // meters at which depth weighs nothing any more
    float feather_start;  // relative emission that counts as much as an opaque fragment
    uint reveal;
    uint normalization;
    uint tiles;
};

struct WeightedAdditiveCounters {
    uint fragments;
    uint tiles_skipped;
};

const uint tile_edge = 8u;  // pixels

#ifdef __cplusplus
}
#endif
#endif
