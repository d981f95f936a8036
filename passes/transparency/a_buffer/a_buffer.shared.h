// What the bounded A-buffer's C++ and shaders share.
#ifndef PASSES_TRANSPARENCY_A_BUFFER_SHARED_H
#define PASSES_TRANSPARENCY_A_BUFFER_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::transparency {
#endif

// How transmittance is stored: as the frame needs it; 8 bits; R11G11B10F.
const uint layout_automatic = 0u;
const uint layout_mono = 1u;
const uint layout_rgb = 2u;

struct ABufferPush {
    uint layers;
    uint chromatic;  // 1: three transmittances are stored
};

struct ABufferCounters {
    uint fragments;
    uint overflow;
    uint atomics;
    uint unfinished;
};

#ifdef __cplusplus
}
#endif
#endif
