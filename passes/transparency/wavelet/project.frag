// Adds a fragment's step in optical depth to the coefficients of its texel: rank + 2 of them change. A tent is the primitive of
// the Haar wavelet.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/fragment.glsl"
#include "passes/transparency/wavelet/wavelet.shared.h"

layout(push_constant, scalar) uniform Push { WaveletPush push; };
#include "passes/transparency/wavelet/cells.glsl"

layout(early_fragment_tests) in;
layout(constant_id = 12) const uint channel = 3u;  // of transmittance; 3: their luminance
layout(location = 0) out vec4 out_coefficients[8];

void main() {
    const Fragment fragment = transparent_fragment();
    const float tau = wavelet_depth(fragment.t, channel);
    if (!fragment.visible || tau <= 0.0) discard;
    const float x = cell_of_depth(fragment.z, uvec2(gl_FragCoord.xy)) / float(cells);
    float coefficients[32];
    for (uint i = 0u; i < 32u; ++i) coefficients[i] = 0.0;
    for (uint p = 0u; p <= rank; ++p) {
        const float width = exp2(-float(p)), k = floor(x / width);
        coefficients[(1u << p) - 1u + uint(k)] = tau * root_of_two_to(p) * min(x - k * width, (k + 1.0) * width - x);
    }
    coefficients[cells - 1u] = tau * (1.0 - x);
    for (uint i = 0u; i < 8u; ++i)
        out_coefficients[i] = vec4(coefficients[4u * i], coefficients[4u * i + 1u], coefficients[4u * i + 2u], coefficients[4u * i + 3u]);
}
