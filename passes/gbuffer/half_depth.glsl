// View depth as a half float, for layouts that keep it so.
#ifndef PASSES_GBUFFER_HALF_DEPTH_GLSL
#define PASSES_GBUFFER_HALF_DEPTH_GLSL
#include "passes/gbuffer/codes.glsl"
#include "passes/shaders/largest_half.glsl"
#include "passes/shaders/scene.glsl"

// z is extrapolated to the pixel's center and may lie before the near plane, or behind the eye; 65504 m is the last half.
float pack_half_depth(float z) { return nearest_half(clamp(z, view.near, largest_half)); }

#endif
