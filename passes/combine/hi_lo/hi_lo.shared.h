// What combining's C++ and its shaders share.
#ifndef PASSES_COMBINE_HI_LO_SHARED_H
#define PASSES_COMBINE_HI_LO_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::combine {
#endif

// How a pixel's samples become its display light (docs/algorithms/deferred.md 3.5).
const uint resolve_tone_mapped = 0u;
const uint resolve_linear = 1u;
const uint resolve_weighted = 2u;
const uint resolve_lo_hi = 3u;

struct HiLoParams {
    uint resolve;
};

// Hi = x / 9 in 8 bits: what is brighter clips.
const float hi_scale = 9.0f;

#ifdef __cplusplus
}
#endif
#endif
