// How much surfaces cover of the light along the axes: each piece adds the lobe of its area to the corner of cells that is nearest to it
// (Kaplanyan and Dachsbacher, Cascaded Light Propagation Volumes, I3D 2010: geometry volume; docs/algorithms/lighting.md 5.5). Light that
// travels along an axis sees the lobe of what faces it, light that travels against it the lobe of what faces away: two sums per axis.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/grid.glsl"
#include "passes/indirect/lpv/surfels/surfel.glsl"
#include "passes/shaders/finished.glsl"

layout(set = 0, binding = 0, scalar) buffer Cover { int cover[]; };  // of corner c: [6 c + 2 axis + (against it ? 1 : 0)]
layout(set = 0, binding = 6, scalar) buffer Counters { LpvCounters counters; };

void main() {
    const Surfel s = surfel();
    if (!s.exists) return;
    const ivec3 corner = ivec3(floor((s.place - push.grid.origin) / push.grid.cell + 0.5 + cover_shift)), corners = ivec3(push.grid.cells) + 1;
    if (any(lessThan(corner, ivec3(0))) || any(greaterThanEqual(corner, corners))) return;
    const uint first = 6u * uint((corner.z * corners.y + corner.y) * corners.x + corner.x);
    for (uint i = 0u; i < 6u; ++i) {
        const float cosine = i % 2u == 0u ? s.normal[i / 2u] : -s.normal[i / 2u];
        const int part = int(roundEven(s.area * max(0.0, 0.25 + 0.5 * cosine) * cover_one));
        if (part > 0) atomicAdd(cover[first + i], part);
    }
    if (!finished(view.extent.x)) atomicAdd(counters.unfinished, 1u);
}
