// Where a sample's slots are: one plane of the frame's samples after the other, so that neighbors lie side by side.
#ifndef PASSES_TRANSPARENCY_K_BUFFER_SLOTS_GLSL
#define PASSES_TRANSPARENCY_K_BUFFER_SLOTS_GLSL
#include "passes/shaders/scene.glsl"

// texel.z is the sample.
uint slot_index(ivec3 texel, uint slot) {
    const uint plane = slot * view.samples + uint(texel.z);
    return (plane * view.extent.y + uint(texel.y)) * view.extent.x + uint(texel.x);
}

#endif
