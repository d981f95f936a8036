// What brute-force lighting's C++ and its shader share.
#ifndef PASSES_LIGHTING_BRUTE_FORCE_SHARED_H
#define PASSES_LIGHTING_BRUTE_FORCE_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::lighting {
#endif

// What surfaces are made of: their recorded lighting models, or the nearest of the four materials in the talk's table
// (docs/algorithms/deferred.md 1.6).
const uint materials_recorded = 0u;
const uint materials_table = 1u;
// What a light buffer of diffuse color and one specular intensity keeps of a highlight: its color, or the mean of its channels
// (docs/algorithms/deferred.md 1.5).
const uint specular_colored = 0u;
const uint specular_white = 1u;

struct BruteForceCounters {
    uint evaluations;
    uint samples_shaded;
    uint unfinished;
};

#ifdef __cplusplus
}
#endif
#endif
