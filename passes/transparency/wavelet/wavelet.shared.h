// What wavelet transparency's C++ and shaders share.
#ifndef PASSES_TRANSPARENCY_WAVELET_SHARED_H
#define PASSES_TRANSPARENCY_WAVELET_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::transparency {
#endif

const uint storage_half_float = 0u;
const uint storage_float = 1u;

const uint bounds_frame = 0u;
const uint bounds_pixel = 1u;

const uint correction_none = 0u;
const uint correction_own = 1u;

// Push constants of the steps.
struct WaveletPush {
    float log_nearest;  // of the frame's range of depth, in ln meters
    float log_farthest;
    float jitter;
    uint width;  // texels of a row of the prepass
    uint height;
    uint channels;  // 1 or 3
};

// Optical depth of one fragment is written up to here: t = 1e-5 (Aizenshtein, Smal and McGuire 2022).
const float largest_wavelet_depth = 11.51f;
// Per-pixel bounds are wider than what they hold by so much in ln z: a fragment never is at the last cell's end.
const float bounds_margin = 1e-3f;

#ifdef __cplusplus
}
#endif
#endif
