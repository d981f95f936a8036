// Where the samples of a pixel lie: Vulkan's standard places (docs/algorithms/deferred.md 0.4).
#ifndef PASSES_SHADERS_SAMPLE_PLACES_GLSL
#define PASSES_SHADERS_SAMPLE_PLACES_GLSL

// Of 4 samples, from the pixel's center, in pixels.
const vec2 sample_places[4] = vec2[](vec2(-0.125, -0.375), vec2(0.375, -0.125), vec2(-0.375, 0.125), vec2(0.125, 0.375));

// Of 1 or 4 samples.
vec2 sample_place(uint samples, uint i) {
    if (samples == 1u) return vec2(0.0);
    return sample_places[i];
}

#endif
