// How many blockers are near the macro-cell that a pixel reads its cells in; nothing outside of the grid.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gbuffer/surface_at.glsl"
#include "passes/indirect/lpv/apply/taps.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { ApplyPush push; };
layout(set = 0, binding = 1, rgba32f) writeonly uniform image2D picture;

void main() {
    const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(picture)))) return;
    const Surface s = surface_at(ivec3(at, 0));
    if (!s.exists) return;
    const LitPlace lit = lit_place(s, uvec2(at));
    if (depth_inside(push.grid, lit.place) <= 0.0) return;
    imageStore(picture, at, vec4(vec3(float(seen_light(push.grid, lit).near)), 1.0));
}
