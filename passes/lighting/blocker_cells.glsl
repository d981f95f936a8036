// A blocker or portal of one light against a cell (docs/algorithms/lighting.md 2.3): its shadow is the convex unbounded
// polyhedron behind the rectangle, within the four planes through the light and an edge. Never wrong: `none` and `full` hold for
// every point that off_surface() may make of a point of the cell, and what cannot be proven is `partial`.
// passes/lighting/cells.cpp is the same on the CPU.
#ifndef PASSES_LIGHTING_BLOCKER_CELLS_GLSL
#define PASSES_LIGHTING_BLOCKER_CELLS_GLSL
#include "passes/lighting/cell.glsl"
#include "passes/shaders/blockers.glsl"

const uint class_none = 0u, class_partial = 1u, class_full = 2u;

// Least and greatest signed distance of the cell's corners from the plane through `origin`.
vec2 corner_range(Cell cell, vec3 normal, vec3 origin) {
    vec2 range = vec2(1.0, -1.0) * 3e38;
    for (int i = 0; i < 8; ++i) {
        const float d = precise_dot(normal, cell.corners[i] - origin);
        range = vec2(min(range.x, d), max(range.y, d));
    }
    return range;
}

// Counter-clockwise around the normal.
vec3 rectangle_corner(BlockerRecord r, uint i) {
    const vec3 u = r.u * r.half_u, v = precise_cross(r.normal, r.u) * r.half_v;
    return r.center + (i == 1u || i == 2u ? u : -u) + (i >= 2u ? v : -v);
}

// Whether a tile plane has the whole shadow outside: the rectangle, and the directions in which the shadow has no end.
bool beyond_tile(BlockerRecord r, vec4 light, Cell cell, float margin) {
    for (int plane = 0; plane < 6; ++plane) {
        const vec4 t = cell.planes[plane];
        bool outside = true;
        for (uint i = 0u; i < 4u; ++i) {
            const vec3 q = rectangle_corner(r, i);
            outside = outside && precise_dot(t.xyz, q) + t.w <= -margin && precise_dot(t.xyz, q * light.w - light.xyz) <= 0.0;
        }
        if (outside) return true;
    }
    return false;
}

uint classify_rectangle(BlockerRecord r, vec4 light, Cell cell) {
    const float height = stopped_height(r, light);
    if (height == 0.0) return class_none;
    const float facing = height < 0.0 ? -1.0 : 1.0;
    const float size = length(light.w > 0.0 ? light.xyz : r.center) + cell.z_far;
    const float bias = max(least_surface_offset, surface_offset_per_meter * cell.z_far);
    const float margin = classification_margin * size + bias;
    const vec2 behind = corner_range(cell, -facing * r.normal, r.center) - point_behind_blocker;
    if (behind.y <= -margin) return class_none;
    bool full = behind.x >= margin;
    for (uint i = 0u; i < 4u; ++i) {
        const vec3 q = rectangle_corner(r, i), edge = rectangle_corner(r, (i + 1u) & 3u) - q, to_light = light.xyz - q * light.w;
        const vec3 normal = facing * precise_cross(to_light, edge);  // inward
        const float area = length(normal), lengths = length(to_light) * length(edge);
        if (!(area > degenerate_sine * lengths)) {
            full = false;
            continue;
        }
        const float side_margin = margin + grazing_margin * size * (lengths / area);
        const vec2 inside = corner_range(cell, normal / area, q);
        if (inside.y <= -side_margin) return class_none;
        full = full && inside.x >= side_margin;
    }
    if (full) return class_full;
    return beyond_tile(r, light, cell, margin) ? class_none : class_partial;
}

// A portal as a rectangle of its own, in the blocker's plane.
BlockerRecord portal_rectangle(BlockerRecord blocker, BlockerPortalRecord portal) {
    const vec3 v = precise_cross(blocker.normal, blocker.u);
    BlockerRecord r = blocker;
    r.center = blocker.center + blocker.u * portal.center.x + v * portal.center.y;
    r.u = blocker.u * portal.turn.x + v * portal.turn.y;
    r.half_u = portal.half_extent.x;
    r.half_v = portal.half_extent.y;
    return r;
}

BlockerRecord rectangle_of_blocker(LightRecord light, uint local) {
    return blockers[light_blockers[light.first_blocker + local].blocker];
}

BlockerRecord rectangle_of_portal(LightRecord light, uint local) {
    const BlockerPortalRecord portal = blocker_portals[light.first_portal + local];
    return portal_rectangle(blockers[portal.blocker], portal);
}

#endif
