// On which side of a blocker's plane a place lies, for ways of bounced light (passes/indirect/ways.glsl).
#ifndef PASSES_INDIRECT_WAYS_SHARED_H
#define PASSES_INDIRECT_WAYS_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::indirect {
#endif

// Meters within which a place lies on the plane. It belongs to the side that this direction of the world points to: blockers in
// one plane, whichever way they face and however their heights are rounded, agree about it.
const float on_plane = 1e-3f;
const vec3 side_of_plane = vec3(1.0f, 0.37f, 0.14f);

#ifdef __cplusplus
}
#endif
#endif
