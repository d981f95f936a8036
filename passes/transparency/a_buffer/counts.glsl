// How many fragments a sample got, in 8 bits, four samples to a word. The four lie a quarter of the frame apart, so that
// neighbors do not fight for a word. Declare the buffer `Counts { uint counts[]; }` before.
#ifndef PASSES_TRANSPARENCY_A_BUFFER_COUNTS_GLSL
#define PASSES_TRANSPARENCY_A_BUFFER_COUNTS_GLSL
#include "passes/shaders/scene.glsl"

const uint most_counted = 255u;

struct CountPlace {
    uint word, shift;
};

// texel.z is the sample.
CountPlace count_place(ivec3 texel) {
    const uint cells = view.extent.x * view.extent.y * view.samples, words = (cells + 3u) / 4u;
    const uint cell = (uint(texel.z) * view.extent.y + uint(texel.y)) * view.extent.x + uint(texel.x);
    return CountPlace(cell % words, cell / words * 8u);
}

uint count_in(uint word, CountPlace place) { return word >> place.shift & most_counted; }

#endif
