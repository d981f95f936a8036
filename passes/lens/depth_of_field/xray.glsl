// X-Ray's depth of field (docs/algorithms/deferred.md 8.7): how blurred a sample is, and where its taps lie.
#ifndef PASSES_LENS_XRAY_GLSL
#define PASSES_LENS_XRAY_GLSL
#include "passes/lens/depth_of_field/blur.glsl"

const vec2 xray_taps[12] = vec2[12](vec2(-0.326212, -0.405810), vec2(-0.840144, -0.073580), vec2(-0.695914, 0.457137),
                                    vec2(-0.203345, 0.620716), vec2(0.962340, -0.194983), vec2(0.473434, -0.480026),
                                    vec2(0.519456, 0.767022), vec2(0.185461, -0.893124), vec2(0.507431, 0.064425),
                                    vec2(0.896420, 0.412458), vec2(-0.321940, -0.932615), vec2(-0.791559, -0.597710));

// Meters; what has no surface counts as near as xray_sky.
float xray_depth(ivec3 at) {
    const float d = depth_at(at);
    return d > 0.0 ? view.near / d : xray_sky;
}

// b(z): 0 in focus, 1 at xray_far.
float factor_at(ivec3 at) {
    const float z = xray_depth(at);
    const float beyond = clamp((z - push.focus) / (xray_far - push.focus), 0.0, 1.0);
    const float before = clamp((z - push.focus) / (xray_near - push.focus), 0.0, 1.0);
    return (beyond + before) * (beyond + before);
}

// Of the taps around a sample with this factor, in pixels.
vec2 xray_radius(float factor) {
    const ivec2 size = textureSize(color, 0).xy;
    return factor * vec2(xray_radius_u, xray_radius_v) * vec2(size);
}

// The sample whose factor is the weight of the tap at a place.
ivec3 tapped_sample(vec2 place, int layer) {
    return ivec3(clamp(ivec2(floor(place)), ivec2(0), textureSize(color, 0).xy - 1), layer);
}

#endif
