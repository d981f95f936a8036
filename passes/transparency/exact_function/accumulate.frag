// T(z) is the product over the fragments of the list that are strictly nearer; coincident fragments do not hide each other.
// Draws at half resolution read the list of a pixel under their center.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/fragment.glsl"
#include "passes/transparency/functions/outputs.glsl"
#include "passes/transparency/lists/pixel_lists.shared.h"

layout(push_constant, scalar) uniform Push { Band band; };
#include "passes/transparency/lists/fragments.glsl"

layout(early_fragment_tests) in;
layout(set = 0, binding = 20, scalar) buffer Counters { FunctionCounters counters; };

// Of the fragments strictly nearer than z: products.comp left the product of all up to each.
vec3 transmittance(uint start, uint count, float z) {
    uint low = 0u, high = count;
    while (low < high) {
        const uint middle = (low + high) / 2u;
        if (keys[start + middle].z < z) low = middle + 1u;
        else high = middle;
    }
    return low > 0u ? fragments[keys[start + low - 1u].fragment].t : vec3(1.0);
}

void main() {
    const Fragment fragment = transparent_fragment();
    const uvec2 pixel = texel_under(view.extent);
    if (!fragment.visible || !in_band(pixel.y)) discard;
    const uint cell = cell_of(pixel, gl_SampleID);
    atomicAdd(counters.drawn, 1u);
    if (is_clamped(fragment)) atomicAdd(counters.clamped, 1u);
    write_fragment(fragment, transmittance(starts[cell], list_count(cell), fragment.z));
}
