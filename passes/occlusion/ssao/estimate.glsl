// What estimators of ambient visibility share: their taps.
#ifndef PASSES_OCCLUSION_SSAO_ESTIMATE_GLSL
#define PASSES_OCCLUSION_SSAO_ESTIMATE_GLSL
#include "passes/occlusion/ssao/noise.glsl"
#include "passes/occlusion/ssao/places.glsl"

layout(constant_id = 5) const uint directions = 4u;  // slices, or directions of a ring
layout(constant_id = 6) const uint steps = 3u;       // taps on each side of a slice, or rings

layout(push_constant, scalar) uniform Push { SsaoPush push; };

// What one sample's estimate has read.
struct Tally {
    uint taps, in_reach;
};

// The sample that is estimated.
struct Center {
    Place place;
    vec3 to_eye;  // unit
    vec2 pixel;   // its center
    int sample_index;
    vec2 noise;
};

#endif
