// Adds tap visibility to the spectra of tiles in which a surface reads cells of a light volume near a blocker (docs/algorithms/lighting.md
// 3.2, GI_TAP_VIS). Light volumes are read by the stage before: lights are shaded without this bit, and nothing but the table and the views
// of spectra asks for it. One group per tile.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gbuffer/surface_at.glsl"
#include "passes/indirect/volume_light.glsl"
#include "passes/lighting/tiled/tiled.shared.h"
#include "passes/shaders/light_features.shared.h"

layout(local_size_x = 256) in;

layout(set = 0, binding = 5, scalar) buffer Records { TileRecord records[]; };

shared uint is_near;

bool reads_near_blockers(LitPlace lit) {
    for (uint i = 0u; i < light_grids; ++i) {
        const vec4 corner = grid_texel(i, 0u), size = grid_texel(i, 1u);
        const GridPlace grid = GridPlace(corner.xyz, corner.w, uvec3(size.xyz));
        if (depth_inside(grid, lit.place) > 0.0 && near_list(grid, lit, i).count > 0u) return true;
    }
    return false;
}

bool needs_tap_visibility(ivec3 at) {
    const Surface s = surface_at(at);
    if (!s.exists) return false;
    const MaterialPoint m = lit_point(s, uvec2(at.xy));
    const vec3 n = facing_normal(m.lighting_model, m.normal, m.position);
    return reads_near_blockers(LitPlace(view.to_world * m.position, view.to_world * n));
}

void main() {
    const uint thread = gl_LocalInvocationIndex, tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    if (thread == 0u) is_near = 0u;
    barrier();
    const ivec3 extent = textureSize(gbuffer0, 0);
    const ivec2 pixel = ivec2(gl_WorkGroupID.xy * tile_size + uvec2(thread % tile_size, thread / tile_size));
    if (all(lessThan(pixel, extent.xy)))
        for (int i = 0; i < extent.z; ++i)
            if (needs_tap_visibility(ivec3(pixel, i))) atomicOr(is_near, 1u);
    barrier();
    if (thread == 0u && is_near != 0u) records[tile].spectrum |= feature_gi_tap_visibility;
}
