// Thresholds of light blockers (docs/algorithms/lighting.md 2.2 and 2.3), meters unless said otherwise.
// passes/reference/blockers.cpp has its own, and passes/scene/light_blockers.cpp has those of lights in double.
#ifndef PASSES_SHADERS_BLOCKERS_SHARED_H
#define PASSES_SHADERS_BLOCKERS_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
#endif

// How far a surface is asked about along its normal: so far, or so much per meter of view depth.
const float least_surface_offset = 0.01f;
const float surface_offset_per_meter = 5e-4f;
// How far a point must lie behind a blocker's plane to be in its shadow: half of that, so that a face in the plane is safely on
// its own side.
const float point_behind_blocker = 5e-3f;
// How far a light must be from that plane to be stopped; of a directional light the cosine to the normal.
const float light_before_blocker = 0.02f;
const float direction_before_blocker = 1e-3f;

// What a distance from a shadow's plane may be off by rounding, beyond what the offset of surfaces makes of it: a share of the
// size of the numbers in it (docs/algorithms/lighting.md 2.3: 2e-6 fails once in 300000 cells, 5e-6 never in two million), and a
// share of that size over the sine between light and edge, by which the rounding of a cross product turns the plane.
const float classification_margin = 1e-5f;
const float grazing_margin = 4e-7f;
// Below this sine an edge and the light make no plane.
const float degenerate_sine = 1e-6f;

#ifdef __cplusplus
}
#endif
#endif
