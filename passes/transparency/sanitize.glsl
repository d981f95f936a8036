// Bad numbers stop here (docs/algorithms/transparency.md 0.2): every transparent shader gets its fragments through fragment.glsl, which
// uses these. NaN is found by its bits; comparing x != x is optimized away by fast-math drivers.
#ifndef PASSES_TRANSPARENCY_SANITIZE_GLSL
#define PASSES_TRANSPARENCY_SANITIZE_GLSL
#include "passes/shaders/largest_half.glsl"  // resolves read what is above, and infinity, as this

bool is_finite(float x) { return (floatBitsToUint(x) & 0x7fffffffu) < 0x7f800000u; }

float finite_or_zero(float x) { return is_finite(x) ? x : 0.0; }

vec3 finite_or_zero(vec3 x) { return vec3(finite_or_zero(x.r), finite_or_zero(x.g), finite_or_zero(x.b)); }

// Coverage in 0..1; 0 where it is no number.
float valid_alpha(float alpha) { return clamp(finite_or_zero(alpha), 0.0, 1.0); }

// A fragment that nobody could see: it neither hides nor adds (premultiplied fire has no alpha and all its light in p). Not 1/255:
// 200 layers of .01 must survive.
bool invisible(float alpha, vec3 scattered, vec3 emission) {
    const float least_alpha = 1e-5, least_emission = 1e-6;
    return alpha < least_alpha && max(scattered.r, max(scattered.g, scattered.b)) < least_alpha &&
           max(emission.r, max(emission.g, emission.b)) < least_emission;
}

#endif
