// Builds the step curve of every sample of the band from its fragments in the order of submission, as an ordered interlock would
// (Salvi, Montgomery and Lefohn 2011, algorithm 1).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/adaptive/adaptive.shared.h"
#include "passes/transparency/functions/function.shared.h"
#include "passes/transparency/lists/pixel_lists.shared.h"

layout(push_constant, scalar) uniform Push { Band band; };
#include "passes/shaders/finished.glsl"
#include "passes/transparency/lists/fragments.glsl"
#include "passes/transparency/lists/per_iteration.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint curve_nodes = 8u;
layout(set = 0, binding = 6, scalar) writeonly buffer Curves { CurveNode curves[]; };
layout(set = 0, binding = 7, scalar) buffer Counters { FunctionCounters counters; };

const float far_away = 3.402823466e38;

CurveNode nodes[most_curve_nodes + 1u];  // indexed by constants alone: registers, and loops that are unrolled
uint used = 0u;

float gray(vec3 t) { return dot(t, vec3(1.0 / 3.0)); }

// A fragment hides everything behind it, whatever was there before.
void insert(float z, vec3 t) {
    uint place = 0u;
    [[unroll]] for (uint i = 0u; i < curve_nodes; ++i) place += i < used && nodes[i].z < z ? 1u : 0u;
    [[unroll]] for (uint k = 0u; k < curve_nodes; ++k) {
        const uint i = curve_nodes - k;
        if (i >= place) nodes[i] = CurveNode(i == place ? z : nodes[i - 1u].z, nodes[i - 1u].t * t);
    }
    if (place == 0u) nodes[0] = CurveNode(z, t);
    ++used;
}

// Removes the node whose step moved to the one before it changes the least area: T is underestimated between them. Never the last:
// what shows through everything stays where it is.
void remove_least() {
    uint least = 1u;
    float least_area = far_away;
    [[unroll]] for (uint i = 1u; i < curve_nodes; ++i) {
        const float area = (nodes[i].z - nodes[i - 1u].z) * (gray(nodes[i - 1u].t) - gray(nodes[i].t));
        if (area < least_area) {
            least = i;
            least_area = area;
        }
    }
    [[unroll]] for (uint i = 0u; i < curve_nodes; ++i) {
        if (i + 1u == least) nodes[i].t = nodes[i + 1u].t;
        if (i >= least) nodes[i] = nodes[i + 1u];
    }
    --used;
}

void add(ListKey key) {
    insert(key.z, fragments[key.fragment].t);
    if (used > curve_nodes) remove_least();
}

void main() {
    const uvec3 at = gl_GlobalInvocationID;
    if (at.x >= band.width || at.y >= band.rows) return;
    const uvec2 pixel = uvec2(at.x, at.y + band.first_row);
    const uint cell = cell_of(pixel, at.z), start = starts[cell], count = list_count(cell);
    for (uint i = 0u; i < count; i += per_iteration)
        [[unroll]] for (uint k = 0u; k < per_iteration; ++k)
            if (i + k < count) add(keys[start + i + k]);
    if (!finished(band.width)) atomicAdd(counters.lists.unfinished, 1u);
    const uint first = cell * curve_nodes;
    for (uint i = 0u; i < curve_nodes; ++i) curves[first + i] = i < used ? nodes[i] : CurveNode(far_away, vec3(0.0));
}
