// What the K-buffer's C++ and shaders share.
#ifndef PASSES_TRANSPARENCY_K_BUFFER_SHARED_H
#define PASSES_TRANSPARENCY_K_BUFFER_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::transparency {
#endif

// What becomes of fragments behind the K nearest: nothing; blended as they fall out; averaged.
const uint tail_drop = 0u;
const uint tail_blend = 1u;
const uint tail_hybrid = 2u;

struct KBufferParams {
    uint layers;
    uint tail;
};

struct KBufferCounters {
    uint fragments;
    uint displaced;
    uint atomics;
};

#ifdef __cplusplus
}
#endif
#endif
