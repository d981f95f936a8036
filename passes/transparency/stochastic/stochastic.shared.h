// What stochastic transparency's C++ and shaders share.
#ifndef PASSES_TRANSPARENCY_STOCHASTIC_SHARED_H
#define PASSES_TRANSPARENCY_STOCHASTIC_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::transparency {
#endif

// How the subsamples that a fragment covers are drawn: each on its own, or a fixed number of them.
const uint subset_bernoulli = 0u;
const uint subset_stratified = 1u;

// What shows through: the uncovered subsamples, or the exact product of transmittances.
const uint correction_none = 0u;
const uint correction_alpha = 1u;

// The nearest fragment of each subsample; every fragment by the share of subsamples it is not behind of; or one subsample that a
// fragment covers where its alpha exceeds a threshold fixed to the surface.
const uint mode_layered = 0u;
const uint mode_depth_based = 1u;
const uint mode_hashed = 2u;

struct StochasticParams {
    uint samples;  // 4 << samples subsamples per sample
    uint subset;
    uint correction;
    uint mode;
    uint seed;
    float memory;  // MiB of subsample depths at a time
};

// Rows of the frame that are done together: push constants of every step.
struct StochasticBand {
    StochasticParams params;
    uint first_row;
    uint rows;
    uint width;       // pixels
    uint samples;     // per pixel
    uint subsamples;  // per sample
};

struct StochasticCounters {
    uint fragments;
    uint atomics;
};

// Subsamples that nothing covers.
const uint uncovered_depth = 0xffffffffu;
// Less coverage than this is no fragment (docs/algorithms/transparency.md 0.2): such a fragment covers nothing, and its light is
// added.
const float least_coverage = 1e-5f;

#ifdef __cplusplus
}
#endif
#endif
