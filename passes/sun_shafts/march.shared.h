// What the C++ and the shaders of marched sun shafts share.
#ifndef PASSES_SUN_SHAFTS_MARCH_SHARED_H
#define PASSES_SUN_SHAFTS_MARCH_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::sun_shafts {
#endif

// shaft_taps: texels compared per step
const uint taps_1 = 0u;
const uint taps_4 = 1u;
// shaft_stepping (docs/algorithms/deferred.md 6.2)
const uint stepping_stratified = 0u;
const uint stepping_xray = 1u;
// shaft_jitter
const uint jitter_none = 0u;
const uint jitter_interleaved_gradient = 1u;
const uint jitter_hash = 2u;
const uint jitter_interleaved = 3u;
// shaft_resolution
const uint resolution_full = 0u;
const uint resolution_half = 1u;
// shaft_extinction
const uint extinction_integrated = 0u;
const uint extinction_sampled = 1u;
// shaft_normalization
const uint normalization_physical = 0u;
const uint normalization_steps = 1u;
// shaft_phase
const uint phase_isotropic = 0u;
const uint phase_xray = 1u;
const uint phase_henyey_greenstein = 2u;
// shaft_cascade
const uint cascade_of_step = 0u;
const uint cascade_last = 1u;
// shaft_bounds: which bounds of the shadows' technique are asked in place of own ones
const uint bounds_as_narrow = 0u;
const uint bounds_shared = 1u;

struct MarchPush {
    vec3 radiance;    // of a ray that scatters all of the sun's light and is lit throughout
    float far;        // view depth in meters where rays end, if no surface ends them
    vec3 to_sun;      // unit, view space
    float asymmetry;  // g of Henyey and Greenstein
};

// Units of 1024: at 1920 x 1080 x 4 samples x 128 steps x 4 texels the texels themselves would reach 99 % of 32 bits.
struct MarchCounters {
    uint rays;
    uint kilosteps;
    uint kilofetches;            // texels of shadow maps
    uint kilobounds;             // texels of bounds and their nodes
    uint kiloskipped;            // steps that bounds decide
    uint kilosteps_in_segments;  // of these, by one answer for a segment
    // The same, one by one, modulo 2^32: what the units above are carried from.
    uint steps;
    uint fetches;
    uint bounds;
    uint skipped;
    uint in_segments;
};

#ifdef __cplusplus
}
#endif
#endif
