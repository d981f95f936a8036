// Shades the band's fragments and stores each in its cell's list. The slot within the list comes from an atomic and differs from
// run to run; what the sorted list says does not, because no two fragments of a sample have the same key. This draw and that of
// count.frag have vertex shaders of their own: what one covers and the other does not is counted, and stored in no other list.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/fragment.glsl"
#include "passes/transparency/lists/pixel_lists.shared.h"

layout(push_constant, scalar) uniform Push { Band band; };
#include "passes/transparency/lists/starts.glsl"

layout(early_fragment_tests) in;
layout(set = 0, binding = 1, scalar) buffer Ends { uint ends[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer Keys { ListKey keys[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer Submissions { ListSubmission submissions[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer Fragments { ListFragment fragments[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer Offsets { vec2 offsets[]; };
layout(set = 0, binding = 6, scalar) buffer Counters { ListCounters counters; };

void main() {
    const Fragment fragment = transparent_fragment();
    const uvec2 pixel = uvec2(gl_FragCoord.xy);
    if (!fragment.visible || !in_band(pixel.y)) return;
    const uint cell = cell_of(pixel, gl_SampleID), node = atomicAdd(ends[cell], 1u);
    if (node >= room_end(cell)) {
        if (node >= band.pool) atomicAdd(counters.dropped, 1u);
        else atomicAdd(counters.miscounted, 1u);
        return;
    }
    keys[node] = ListKey(fragment.z, node);
    submissions[node] = ListSubmission(in_draw, in_triangle);
    fragments[node] = ListFragment(fragment.p, fragment.t, fragment.e);
    if (distorts != 0u) offsets[node] = fragment.d;
}
