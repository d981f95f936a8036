// How the pyramid of farthest depths lies in its buffer: level after level, each half as wide and high as the one before,
// rounded up, so that texel (x, y) of level n is exactly the pixels from (x, y) 2^n on, 2^n of them each way, as far as the
// picture goes. Halving rounded down, as mips do, would lose the last column of an odd level.
#ifndef PASSES_CULLING_HIZ_TWO_PHASE_PYRAMID_GLSL
#define PASSES_CULLING_HIZ_TWO_PHASE_PYRAMID_GLSL
#include "passes/culling/hiz_two_phase/hiz_two_phase.shared.h"
#include "passes/shaders/scene.glsl"

// Nearer than anything: device depth ends at 1.
const float no_depth = 2.0;

uvec2 level_size(uint level) { return (view.extent + (1u << level) - 1u) >> level; }

// Of one texel.
uint last_level() { return uint(findMSB(max(view.extent.x, view.extent.y) - 1u) + 1); }

uint level_begin(uint level) {
    uint begin = 0u;
    for (uint finer = 0u; finer < level; ++finer) begin += level_size(finer).x * level_size(finer).y;
    return begin;
}

#endif
