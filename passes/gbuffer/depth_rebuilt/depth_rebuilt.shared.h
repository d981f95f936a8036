// What the C++ model and the shaders of the layout with rebuilt depth share.
#ifndef PASSES_GBUFFER_DEPTH_REBUILT_SHARED_H
#define PASSES_GBUFFER_DEPTH_REBUILT_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::gbuffer {
#endif

// Steps of an octahedral coordinate from 0 to 1: those of a 16-bit signed normalized number.
const float depth_rebuilt_steps = 32767.0f;

#ifdef __cplusplus
}
#endif
#endif
