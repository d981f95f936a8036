// How deep a draw's fragments are along the view: nothing, or what its emitter says by how far it fades before opaque surfaces
// (docs/algorithms/transparency.md 6.5, thick objects).
#ifndef PASSES_TRANSPARENCY_VOXEL_THICKNESS_GLSL
#define PASSES_TRANSPARENCY_VOXEL_THICKNESS_GLSL
#include "passes/shaders/scene.glsl"
#include "passes/transparency/voxel/voxel.shared.h"

layout(constant_id = 24) const uint thickness = thickness_point;

// In meters; 0 is a point.
float thickness_of(uint draw) {
    return thickness == thickness_segment && draws[draw].layer == 0u ? draws[draw].soft_fade : 0.0;
}

#endif
