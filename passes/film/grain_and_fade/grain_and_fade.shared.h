// What the grain's C++ and its shader share.
#ifndef PASSES_FILM_GRAIN_AND_FADE_SHARED_H
#define PASSES_FILM_GRAIN_AND_FADE_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::film {
#endif

// grain
const uint grain_centered = 0u;
const uint grain_xray = 1u;
const uint grain_off = 2u;

// Tiles of 64 x 64 pixels hold each of 4096 values once.
const uint grain_tile = 64u;
const uint grain_values = 4096u;

struct GrainPush {
    uint key;  // of the frame's seed and the slot of time
    float amount;
    float fade;
};

#ifdef __cplusplus
}
#endif
#endif
