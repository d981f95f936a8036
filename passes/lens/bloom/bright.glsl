// What of a pixel glows (docs/algorithms/deferred.md 8.6): exposed radiance, the mean of its samples.
#ifndef PASSES_LENS_BRIGHT_GLSL
#define PASSES_LENS_BRIGHT_GLSL
#include "passes/lens/samples.glsl"
#include "passes/shaders/scene.glsl"

layout(constant_id = 20) const uint has_exposure = 0u;

layout(set = 0, binding = 10) uniform sampler2D exposure;

float exposure_scale() { return view.exposure * (has_exposure != 0u ? texelFetch(exposure, ivec2(0), 0).r : 1.0); }

ivec2 inside(ivec2 pixel) { return clamp(pixel, ivec2(0), textureSize(color, 0).xy - 1); }

// The part of a color above the threshold, in its own hue.
vec3 above(vec3 exposed, float threshold) {
    const float most = max(exposed.r, max(exposed.g, exposed.b));
    return most > threshold ? exposed * ((most - threshold) / most) : vec3(0.0);
}

#endif
