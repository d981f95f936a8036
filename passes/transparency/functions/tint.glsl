// Color where T(z) has one channel (docs/algorithms/transparency.md 6.12): what is drawn is multiplied by T' / luminance(T'), T'
// being the product of all layers' transmittance, each as far as it is seen. Only what T' has of red and blue more than of green
// matters, so two sums of optical depth say it, to which what is gray adds exactly 0.
#ifndef PASSES_TRANSPARENCY_TINT_GLSL
#define PASSES_TRANSPARENCY_TINT_GLSL
#include "passes/transparency/functions/optical_depth.glsl"

// What a fragment adds. seen: T(z), fogged.
vec2 skew_depths(vec3 t, float seen) {
    const vec3 tau = optical_depth(t);
    const vec3 more = min(tau - min(tau.r, min(tau.g, tau.b)), largest_skew_depth);
    return seen * (more.rb - more.g);
}

vec3 skew(vec2 depths) {
    const vec3 more = vec3(depths.x, 0.0, depths.y);
    const vec3 through = exp(min(more.r, min(0.0, more.b)) - more);  // 1 in the channel that lets the most through
    return through / luminance(through);
}

#endif
