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

// The share of a surface that fog hides, F of docs/algorithms/deferred.md 8.2: exponential is what is recorded, linear what the
// talk's engine has.
const uint fog_exponential = 0u;
const uint fog_linear = 1u;
// The way through fog, to the pixel's center: that of the recorded frame, or fog_by_...
const uint fog_as_recorded = 2u;
// What fogged surfaces end as: the fog's color, or the background, by F^2.
const uint fog_sky_apart = 0u;
const uint fog_sky_blended = 1u;

// Light of sky and ground: as recorded, or through the talk's table of materials (docs/algorithms/deferred.md 8.3).
const uint hemisphere_recorded = 0u;
const uint hemisphere_table = 1u;

const float least_fog_length = 1e-3f;  // from near to far, in mean free paths: as good as a wall

// F = clamp(factor * meters + offset) of linear fog: fw and fx of docs/algorithms/deferred.md 8.2.
struct LinearFog {
    float factor;
    float offset;
};

// Hi = x / 9 in 8 bits: what is brighter clips.
const float hi_scale = 9.0f;

#ifdef __cplusplus
}
#endif
#endif
