// Thresholds of light blockers (lighting chapter 2.2 and 2.3), metres unless said otherwise. passes/reference/blockers.cpp has its own.
#ifndef PASSES_SHADERS_BLOCKERS_SHARED_H
#define PASSES_SHADERS_BLOCKERS_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
#endif

const float point_behind_blocker = 5e-3f;       // how far a point must lie behind a plane to be in its shadow: half of ...
const float light_before_blocker = 0.02f;      // how far a light must be from that plane to be stopped
const float direction_before_blocker = 1e-3f;  // the same of a directional light: cosine to the normal
const float least_surface_offset = 0.01f;      // ... how far surfaces are asked about along their normal: this far ...
const float surface_offset_per_metre = 5e-4f;  // ... or so much per metre of view depth

// What a rounded distance from a shadow's plane may be off: a share of the size of the numbers in it (measured: 2e-6 fails once in
// 300000 cells, 5e-6 never in two million), and a share of that size over the sine between light and edge, which is how far the
// rounding of a cross product turns the plane.
const float classification_margin = 1e-5f;
const float grazing_margin = 4e-7f;
const float degenerate_sine = 1e-6f;  // below this an edge and the light make no plane

#ifdef __cplusplus
}
#endif
#endif
