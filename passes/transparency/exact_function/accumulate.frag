// T(z) is the product over the fragments of the list that are strictly nearer; coincident fragments do not hide each other.
// Draws at half resolution read the list of a pixel under their center.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/event.glsl"
#include "passes/transparency/functions/outputs.glsl"
#include "passes/transparency/lists/event_lists.shared.h"

layout(push_constant, scalar) uniform Push { Band band; };
#include "passes/transparency/lists/events.glsl"
#include "passes/transparency/lists/finished.glsl"

layout(early_fragment_tests) in;
layout(set = 0, binding = 20, scalar) buffer Counters { FunctionCounters counters; };

vec3 transmittance(uint start, uint count, float z) {
    vec3 through = vec3(1.0);
    for (uint i = 0u; i < count; ++i) {
        const ListKey key = keys[start + i];
        if (key.z >= z) break;
        through *= events[key.event].t;
    }
    return through;
}

void main() {
    const Event event = transparent_event();
    const uvec2 pixel = texel_under(view.extent);
    if (!event.visible || !in_band(pixel.y)) discard;
    const uint cell = cell_of(pixel, gl_SampleID), start = list_start(cell);
    atomicAdd(counters.drawn, 1u);
    const vec3 through = transmittance(start, stored(start, counts[cell]), event.z);
    if (!finished(band.width)) atomicAdd(counters.lists.unfinished, 1u);
    write_event(event, through);
}
