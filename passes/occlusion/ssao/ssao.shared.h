// What screen-space ambient occlusion's C++ and its shaders share.
#ifndef PASSES_OCCLUSION_SSAO_SHARED_H
#define PASSES_OCCLUSION_SSAO_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::occlusion {
#endif

// ao_form
const uint form_horizon = 0u;
const uint form_xray = 1u;
// ao_taps
const uint taps_8 = 0u;
const uint taps_12 = 1u;
const uint taps_24 = 2u;
const uint taps_96 = 3u;
// ao_resolution
const uint resolution_full = 0u;
const uint resolution_half = 1u;
// ao_edge_stop
const uint edge_stop_plane = 0u;
const uint edge_stop_depth = 1u;
// ao_noise
const uint noise_none = 0u;
const uint noise_interleaved = 1u;
const uint noise_hash = 2u;
// ao_material
const uint material_product = 0u;
const uint material_min = 1u;

struct SsaoPush {
    float radius;  // meters
    float depth_error;
    float bias;
};

struct SsaoCounters {
    uint samples;
    uint taps;
    uint out_of_reach;
    uint unfit;
};

#ifdef __cplusplus
}
#endif
#endif
