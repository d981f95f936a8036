// Whether a draw is hidden by the depth of a pyramid. Include it after declaring the buffer Pyramid { float pyramid[]; }.
#ifndef PASSES_CULLING_HIZ_TWO_PHASE_OCCLUSION_GLSL
#define PASSES_CULLING_HIZ_TWO_PHASE_OCCLUSION_GLSL
#include "passes/culling/hiz_two_phase/pyramid.glsl"

// In the finest level in which bounds are at most `across` texels wide and high.
float farthest_depth(ivec2 first, ivec2 last, uint across) {
    int level = 0;
    while (any(greaterThanEqual((last >> level) - (first >> level), ivec2(across)))) ++level;
    const uint begin = level_begin(uint(level)), width = level_size(uint(level)).x;
    float farthest = no_depth;
    for (int y = first.y >> level; y <= last.y >> level; ++y)
        for (int x = first.x >> level; x <= last.x >> level; ++x)
            farthest = min(farthest, pyramid[begin + uint(y) * width + uint(x)]);
    return farthest;
}

// Of a draw in view. Bounds without a sample in them hide what nobody could draw. A number that is none hides nothing.
bool is_hidden(HizDraw draw, uint across) {
    if ((draw.state & hiz_at_eye) != 0u) return false;
    if (any(lessThan(draw.last, draw.first))) return true;
    return draw.nearest * (1.0 + depth_slack) < farthest_depth(draw.first, draw.last, across);
}

#endif
