// A pixel is an edge where any sample's words differ in any bit from sample 0 (docs/algorithms/deferred.md 3.2, D1). Emission has
// a 1 on surfaces and 0 elsewhere, so pixels that are partly covered differ, too.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/edges/mark.glsl"
#include "passes/edges/words.glsl"

bool any_word_differs(ivec2 pixel) {
    for (int i = 1; i < sample_count(); ++i)
        if (words_differ(pixel, 0, i)) return true;
    return false;
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    mark(pixel, any_word_differs(pixel), covered_samples(pixel));
}
