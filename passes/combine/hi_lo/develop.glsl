// The curve of display light, and 8-bit targets (docs/algorithms/deferred.md 8.1).
#ifndef PASSES_COMBINE_DEVELOP_GLSL
#define PASSES_COMBINE_DEVELOP_GLSL
#include "passes/combine/hi_lo/hi_lo.shared.h"
#include "passes/shaders/scene.glsl"

// x (1 + x / white^2) / (1 + x) grows everywhere and is 1 at white: clamping before it is clamping after it, without overflow.
vec3 tone_mapped(vec3 exposed) {
    const vec3 x = clamp(exposed, 0.0, view.white);
    return x * (1.0 + x / (view.white * view.white)) / (1.0 + x);
}

// The nearest of the 256 values that an 8-bit target has.
vec3 nearest_byte(vec3 value) { return floor(clamp(value, 0.0, 1.0) * 255.0 + 0.5) / 255.0; }

#endif
