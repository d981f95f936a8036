// What a draw adds to where colors are packed: a material that lets the same of every channel through, as particles do, is gray.
// volume/color_column.h has the same of a frame.
#ifndef PASSES_TRANSPARENCY_VOXEL_SOURCES_GLSL
#define PASSES_TRANSPARENCY_VOXEL_SOURCES_GLSL
#include "passes/shaders/scene.glsl"
#include "passes/transparency/voxel/voxel.shared.h"

uint source_of(uint draw) {
    const vec3 k = materials[draws[draw].material].transmission;
    return k.r == k.g && k.g == k.b ? source_gray : source_color;
}

#endif
