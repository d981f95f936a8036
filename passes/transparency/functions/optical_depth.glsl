// tau = -ln t, and what it hides (docs/algorithms/transparency.md 0.2): series where float would lose the digits of a thin layer.
#ifndef PASSES_TRANSPARENCY_OPTICAL_DEPTH_GLSL
#define PASSES_TRANSPARENCY_OPTICAL_DEPTH_GLSL
#include "passes/transparency/functions/function.shared.h"
#include "passes/shaders/luminance.glsl"

float optical_depth(float t) {
    const float a = 1.0 - t;
    const float series = a * (1.0 + a * (0.5 + a * (1.0 / 3.0)));
    return a < 0.01 ? series : min(-log(max(t, 1e-30)), largest_optical_depth);
}
vec3 optical_depth(vec3 t) { return vec3(optical_depth(t.r), optical_depth(t.g), optical_depth(t.b)); }

// 1 - exp(-x) for x >= 0.
float opacity(float x) { return x < 0.01 ? x * (1.0 - x * (0.5 - x * (1.0 / 6.0))) : 1.0 - exp(-x); }
vec3 opacity(vec3 x) { return vec3(opacity(x.r), opacity(x.g), opacity(x.b)); }

// Of one channel of transmittance; 3: one number for a colored fragment, that of the luminance it lets through
// (docs/algorithms/transparency.md 0.3).
const uint luminance_channel = 3u;
float channel_depth(vec3 t, uint channel) {
    return optical_depth(channel < luminance_channel ? t[channel] : luminance(t));
}

#endif
