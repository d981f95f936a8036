// How many surfaces the samples of a pixel show: those whose words in the G-buffer differ (docs/algorithms/deferred.md 3.4).
#ifndef PASSES_EDGES_VIEWS_SURFACES_GLSL
#define PASSES_EDGES_VIEWS_SURFACES_GLSL
#include "passes/edges/plain_pixels.glsl"
#include "passes/edges/views/views.shared.h"

layout(set = 0, binding = 2) uniform sampler2DArray emission;  // a is 1 on a surface
#include "passes/edges/words.glsl"

int sample_count() { return textureSize(emission, 0).z; }

bool is_covered(ivec2 pixel, int i) { return texelFetch(emission, ivec3(pixel, i), 0).a > 0.0; }

bool is_first_of_its_kind(ivec2 pixel, int i) {
    for (int before = 0; before < i; ++before)
        if (is_covered(pixel, before) && !words_differ(pixel, before, i)) return false;
    return true;
}

uint surfaces_of(ivec2 pixel) {
    uint surfaces = 0u;
    for (int i = 0; i < sample_count(); ++i) surfaces += is_covered(pixel, i) && is_first_of_its_kind(pixel, i) ? 1u : 0u;
    return surfaces;
}

// Of the stage's truth: some samples show another surface, or the sky.
bool is_true_edge(ivec2 pixel) {
    for (int i = 1; i < sample_count(); ++i)
        if (words_differ(pixel, 0, i)) return true;
    return false;
}

bool is_marked(ivec2 pixel) { return has_edges != 0u && !is_plain(pixel); }

#endif
