// What culling techniques share between C++ and shaders: a draw's command, and how much bounding spheres are padded.
#ifndef PASSES_CULLING_DRAW_COMMAND_SHARED_H
#define PASSES_CULLING_DRAW_COMMAND_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
#endif

// Grows every sphere by this share of (1 + its distance + its radius): float planes and spheres are good to about 1e-6 of
// that, and a draw may be kept for nothing but must never be dropped.
const float bound_slack = 1e-5f;

// VkDrawIndexedIndirectCommand; the draw's index into Draws is in first_instance.
struct DrawCommand {
    uint index_count;
    uint instance_count;
    uint first_index;
    int vertex_offset;
    uint first_instance;
};

#ifdef __cplusplus
}
#endif
#endif
