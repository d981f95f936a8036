// The grid that gives a pixel the largest share of its light: its number, and half the share that it leaves to others and to nothing. Grids
// come from the last to the first: each takes its share of what those after it had.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gbuffer/surface_at.glsl"
#include "passes/indirect/lpv/apply/taps.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { ApplyPush push; };
layout(set = 0, binding = 1, rgba32f) uniform image2D picture;

void main() {
    const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(picture)))) return;
    const Surface s = surface_at(ivec3(at, 0));
    if (!s.exists) return;
    const float share = min(depth_inside(push.grid, lit_place(s, uvec2(at)).place) / push.border, 1.0);
    if (share <= 0.0) return;
    const float before = imageLoad(picture, at).x, number = round(before);
    const float share_before = number > 0.0 ? (1.0 - 2.0 * (before - number)) * (1.0 - share) : 0.0;
    const bool is_more = share > share_before;
    const float shown = (is_more ? float(push.number) : number) + 0.5 * (1.0 - max(share, share_before));
    imageStore(picture, at, vec4(vec3(shown), 1.0));
}
