// Blockers and portals as kept grids compare them: wherever the eye is, at the same place up to rounding.
#ifndef PASSES_INDIRECT_LPV_KEPT_BARRIERS_GLSL
#define PASSES_INDIRECT_LPV_KEPT_BARRIERS_GLSL
#include "passes/indirect/grid.glsl"
#include "passes/indirect/lpv/kept/kept.shared.h"
#include "passes/indirect/ways.glsl"

layout(set = 0, binding = 1, scalar) readonly buffer Identities { uvec2 identities[]; };  // of blockers, then of portals

KeptBarrier barrier_at(GridPlace grid, uint identity, BlockerRecord blocker, vec2 center, vec2 half_extent) {
    const vec3 v = cross(blocker.normal, blocker.u);
    const vec3 place = blocker.center + center.x * blocker.u + center.y * v;
    return KeptBarrier(identities[identity], view.to_world * place - grid.origin, length(half_extent), view.to_world * blocker.normal);
}

// Blockers, then portals.
KeptBarrier barrier_of(GridPlace grid, uint i) {
    if (i < blocker_count) return barrier_at(grid, i, blockers[i], vec2(0.0), vec2(blockers[i].half_u, blockers[i].half_v));
    const BlockerPortalRecord portal = portals[i - blocker_count];
    return barrier_at(grid, i, blockers[portal.blocker], portal.center, portal.half_extent);
}

#endif
