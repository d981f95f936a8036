// The nearest and the farthest transparent depth of every texel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/fragment.glsl"
#include "passes/transparency/wavelet/wavelet.shared.h"

layout(push_constant, scalar) uniform Push { WaveletPush push; };
#include "passes/transparency/wavelet/cells.glsl"

layout(early_fragment_tests) in;
layout(set = 0, binding = 20, scalar) buffer Counters { FunctionCounters counters; };

void main() {
    const Fragment fragment = transparent_fragment();
    if (!fragment.visible) discard;
    const uint at = index_of(uvec2(gl_FragCoord.xy)), bits = floatBitsToUint(max(fragment.z, 1e-30));
    atomicMin(bits_of_bounds[at].x, bits);
    atomicMin(bits_of_bounds[at].y, ~bits);
    atomicAdd(counters.lists.atomics, 2u);
}
