// What alpha blending's C++ and shaders share.
#ifndef PASSES_TRANSPARENCY_ALPHA_BLEND_SHARED_H
#define PASSES_TRANSPARENCY_ALPHA_BLEND_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::transparency {
#endif

struct AlphaBlendCounters {
    uint fragments;
};

#ifdef __cplusplus
}
#endif
#endif
