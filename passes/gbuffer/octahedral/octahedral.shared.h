// What the octahedral layout's C++ model and its shaders share: the sizes of its codes.
#ifndef PASSES_GBUFFER_OCTAHEDRAL_SHARED_H
#define PASSES_GBUFFER_OCTAHEDRAL_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::gbuffer {
#endif

// Code of p = 0; -1 is code 0 and 1 is code 61438: 61439 levels, so that 0 is exact (docs/algorithms/deferred.md 2.5).
const float octahedral_center = 30719.0f;

// z = near * far_over_near^(code / 61439). A ratio of 1e5 reaches 10 km from a near plane at 0.1 m with a relative step of
// ln(1e5) / 61439 = 1.87e-4; farther surfaces take the last code.
const float octahedral_far_over_near = 1e5f;
const float octahedral_depth_steps = 61439.0f;

#ifdef __cplusplus
}
#endif
#endif
