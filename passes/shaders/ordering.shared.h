// What puts interfaces in front of the world, for C++ and GLSL (docs/algorithms/transparency.md 6.13).
#ifndef PASSES_SHADERS_ORDERING_SHARED_H
#define PASSES_SHADERS_ORDERING_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
inline float layer_depth(float near, uint layer);
#endif

// A capture's layers are 0, the world, to this one, the nearest.
const uint last_interface_layer = 255u;

// The depth at which an interface layer is ordered, in meters: in front of the near plane, the higher the nearer. Depth is tested
// where the surface is.
float layer_depth(float near, uint layer) { return near / (1.0f + float(layer)); }

#ifdef __cplusplus
}  // namespace strata
#endif
#endif
