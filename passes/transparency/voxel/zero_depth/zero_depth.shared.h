// What the zero-transmittance depth's C++ and shaders share.
#ifndef PASSES_TRANSPARENCY_VOXEL_ZERO_DEPTH_SHARED_H
#define PASSES_TRANSPARENCY_VOXEL_ZERO_DEPTH_SHARED_H
#ifdef __cplusplus
#include "passes/shader_interop.h"
namespace strata::transparency {
#endif

// A tile behind which nothing is seen.
struct ZeroQuad {
    uvec2 tile;
    float depth;  // reversed, as in the depth buffer
};

// An indexed draw command, and the indices it draws.
struct ZeroDraw {
    uint index_count, quads, first_index, vertex_offset, first_instance;
    uint indices[6];
};
const uint zero_draw_first_index = 5u;  // where they stand, in words

// T(z) is computed from another depth than the rasterizer's, and slices from a logarithm in float: a hundredth of a slice, and of
// depth what thin slices far away are thinner than.
const float slice_margin = 0.01f;
const float depth_margin = 4e-6f;

#ifdef __cplusplus
}
#endif
#endif
