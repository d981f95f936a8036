// What frustum culling's C++ and its shader share.
#ifndef PASSES_CULLING_FRUSTUM_SHARED_H
#define PASSES_CULLING_FRUSTUM_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
#endif

// Grows every sphere by this share of (1 + its distance + its radius): float planes and spheres are good to about 1e-6 of
// that, and a draw may be kept for nothing but must never be dropped.
const float frustum_slack = 1e-5f;

// VkDrawIndexedIndirectCommand; the draw's index into Draws is in first_instance.
struct FrustumCommand {
    uint index_count;
    uint instance_count;
    uint first_index;
    int vertex_offset;
    uint first_instance;
};

struct FrustumList {
    uint first;  // command of the list's draw 0
    uint count;  // draws in the list
};

struct FrustumCounters {
    uint tested;
    uint culled;
};

#ifdef __cplusplus
}
#endif
#endif
